//! Means over groups of receivers with the worst beside them.
//!
//! A group is the letters before the first digit of a receiver's name: `A1`, `A2` belong to `A`.
//! Rows carry the mean as `A` and the worst as `A:worst`; a receiver named just `A` is its own
//! group and has one row.

use super::NormError;

/// A number at a place: a receiver (`A1`), a group (`A`), a group's worst (`A:worst`).
#[derive(Clone, Debug, PartialEq)]
pub struct Score {
    /// The place as in the `where` of a row.
    pub place: String,
    /// The number.
    pub value: f64,
}

impl Score {
    /// `value` at `place`.
    pub fn new(place: &str, value: f64) -> Self {
        Score {
            place: place.to_owned(),
            value,
        }
    }
}

/// The group of a receiver: what stands before the first digit, or the whole name if nothing does.
pub fn group_of(receiver: &str) -> &str {
    match receiver.find(|c: char| c.is_ascii_digit()) {
        Some(end) if end > 0 => &receiver[..end],
        _ => receiver,
    }
}

/// The place of a group's worst receiver.
pub fn group_worst(group: &str) -> String {
    format!("{group}:worst")
}

/// The receivers' scores, and after them each group's mean and worst (largest), in the order of
/// first appearance.
pub fn with_groups(scores: &[Score]) -> Result<Vec<Score>, NormError> {
    let mut rows = scores.to_vec();
    for (group, members) in groups(scores) {
        if let [only] = members.as_slice()
            && only.place == group
        {
            continue;
        }
        if members.iter().any(|m| m.place == group) {
            return Err(NormError::AmbiguousReceiver {
                receiver: group.to_owned(),
            });
        }
        let mean = members.iter().map(|m| m.value).sum::<f64>() / members.len() as f64;
        let worst = members
            .iter()
            .fold(f64::NEG_INFINITY, |w, m| w.max(m.value));
        rows.push(Score::new(group, mean));
        rows.push(Score {
            place: group_worst(group),
            value: worst,
        });
    }
    Ok(rows)
}

/// As [`with_groups`] for levels in dB: the mean is the level of the mean ratio.
pub fn with_groups_db(levels: &[Score]) -> Result<Vec<Score>, NormError> {
    let map = |scores: &[Score], f: fn(f64) -> f64| -> Vec<Score> {
        scores
            .iter()
            .map(|s| Score::new(&s.place, f(s.value)))
            .collect()
    };
    let ratios = map(levels, |db| 10f64.powf(db / 20.0));
    let mut rows = map(&with_groups(&ratios)?, |r| 20.0 * r.log10());
    // The receivers' own levels stay as they were measured, free of the round trip.
    rows[..levels.len()].clone_from_slice(levels);
    Ok(rows)
}

/// As [`with_groups`] for scores of which the largest is the best: the worst is the smallest.
pub fn with_groups_of_goodness(scores: &[Score]) -> Result<Vec<Score>, NormError> {
    let negate = |scores: &[Score]| -> Vec<Score> {
        let of = |s: &Score| Score::new(&s.place, -s.value);
        scores.iter().map(of).collect()
    };
    Ok(negate(&with_groups(&negate(scores))?))
}

fn groups(scores: &[Score]) -> Vec<(&str, Vec<&Score>)> {
    let mut groups: Vec<(&str, Vec<&Score>)> = Vec::new();
    for score in scores {
        let group = group_of(&score.place);
        match groups.iter_mut().find(|(name, _)| *name == group) {
            Some((_, members)) => members.push(score),
            None => groups.push((group, vec![score])),
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_the_letters_before_the_first_digit() {
        assert_eq!(group_of("A1"), "A");
        assert_eq!(group_of("toe12"), "toe");
        assert_eq!(group_of("A"), "A");
        assert_eq!(group_of("7"), "7");
    }

    #[test]
    fn mean_and_worst_follow_the_receivers() {
        let rows = with_groups(&[
            Score::new("A1", 1.0),
            Score::new("A2", 4.0),
            Score::new("B", 7.0),
        ])
        .expect("names are clear");
        let expected = [
            ("A1", 1.0),
            ("A2", 4.0),
            ("B", 7.0),
            ("A", 2.5),
            ("A:worst", 4.0),
        ]
        .map(|(place, value)| Score::new(place, value));
        assert_eq!(rows, expected);
    }

    #[test]
    fn a_lone_numbered_receiver_still_has_its_group() {
        let rows = with_groups(&[Score::new("C3", 2.0)]).expect("names are clear");
        assert_eq!(rows.len(), 3);
        assert_eq!(rows[1], Score::new("C", 2.0));
    }

    #[test]
    fn a_receiver_named_like_a_group_is_refused() {
        let rows = with_groups(&[Score::new("A", 1.0), Score::new("A1", 2.0)]);
        assert!(matches!(rows, Err(NormError::AmbiguousReceiver { .. })));
    }

    #[test]
    fn the_worst_goodness_is_the_smallest() {
        let rows = with_groups_of_goodness(&[Score::new("A1", 9.0), Score::new("A2", 4.0)])
            .expect("names are clear");
        let expected = [("A1", 9.0), ("A2", 4.0), ("A", 6.5), ("A:worst", 4.0)];
        assert_eq!(
            rows,
            expected.map(|(place, value)| Score::new(place, value))
        );
    }

    #[test]
    fn levels_are_averaged_as_ratios() {
        let rows = with_groups_db(&[Score::new("A1", 0.0), Score::new("A2", -20.0)])
            .expect("names are clear");
        assert_eq!(rows[1].value, -20.0);
        let mean = rows.iter().find(|r| r.place == "A").expect("mean of A");
        assert!((mean.value - 20.0 * 0.55f64.log10()).abs() < 1e-12);
    }
}
