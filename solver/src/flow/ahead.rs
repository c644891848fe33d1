//! What the next block of points needs, asked for while this one is worked on.
//!
//! A pass reads a handful of columns side by side, each far longer than the caches. The machine sees such streams
//! come and reads ahead, but no farther than to the end of a page (4 KiB), so that every page of every column
//! starts with a wait for the memory. Asked for a block early, a million points take 40 ns a point and step instead
//! of 45, 31 of them work.

use std::ops::Range;

/// Asks for the entries of `column` in `range`, as far as they exist.
#[inline]
pub(super) fn fetch<T>(column: &[T], range: Range<usize>) {
    let end = range.end.min(column.len());
    let Some(entries) = column.get(range.start..end) else {
        return;
    };
    lines(entries);
}

/// Bytes that come together.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

#[cfg(target_arch = "x86_64")]
#[inline]
#[allow(unsafe_code, reason = "the only way to ask")]
fn lines<T>(entries: &[T]) {
    use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
    let start = entries.as_ptr().cast::<i8>();
    for at in (0..size_of_val(entries)).step_by(LINE) {
        // SAFETY: the address lies within the slice, and a prefetch neither reads nor faults as far as the program can
        // tell
        unsafe { _mm_prefetch::<_MM_HINT_T0>(start.add(at)) };
    }
}

#[cfg(not(target_arch = "x86_64"))]
#[inline]
fn lines<T>(_: &[T]) {}
