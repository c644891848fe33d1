//! Shares of a plan: which of its runs a process solves when several work on one study.
//!
//! A share depends on the plan alone, not on what is stored: processes that start at different times
//! and find different runs there still never work on the same one.

use std::fmt;
use std::str::FromStr;
use thiserror::Error;

/// Share `index` of `count`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which, from 1.
    index: usize,
    /// Of how many.
    count: usize,
}

/// Why a text names no share.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("expected SHARE/SHARES with 1 <= SHARE <= SHARES, for example 1/4 for the first of four")]
pub struct NoShard;

impl Shard {
    /// Is the entry at `place` (from 0) of a plan's list in this share?
    pub fn has(&self, place: usize) -> bool {
        place % self.count == self.index - 1
    }

    /// Its part of a list.
    pub fn of<T>(&self, list: impl IntoIterator<Item = T>) -> Vec<T> {
        let placed = list.into_iter().enumerate();
        placed
            .filter_map(|(place, entry)| self.has(place).then_some(entry))
            .collect()
    }

    /// All shares of `count`.
    pub fn all(count: usize) -> impl Iterator<Item = Shard> {
        (1..=count).map(move |index| Shard { index, count })
    }
}

impl FromStr for Shard {
    type Err = NoShard;

    fn from_str(text: &str) -> Result<Self, NoShard> {
        let (index, count) = text.split_once('/').ok_or(NoShard)?;
        let number = |text: &str| text.parse::<usize>().map_err(|_| NoShard);
        let (index, count) = (number(index)?, number(count)?);
        if (1..=count).contains(&index) {
            Ok(Shard { index, count })
        } else {
            Err(NoShard)
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_disjoint_and_together_everything() {
        for count in [1, 2, 3, 7, 20] {
            let mut together: Vec<u32> = Shard::all(count)
                .flat_map(|shard| shard.of(0..11))
                .collect();
            together.sort_unstable();
            assert_eq!(together, (0..11).collect::<Vec<u32>>());
        }
    }

    #[test]
    fn texts_are_read_and_others_refused() {
        let shard: Shard = "2/3".parse().unwrap();
        assert_eq!(
            (shard.to_string(), shard.of(0..7)),
            ("2/3".into(), vec![1, 4])
        );
        for text in ["3/2", "0/2", "0/0", "x", "1", "1/2/3", "-1/2", "1/x", "/"] {
            assert_eq!(text.parse::<Shard>(), Err(NoShard), "{text}");
        }
    }
}
