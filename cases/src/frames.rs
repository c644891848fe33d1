//! Fields over time on request: for ParaView, and for an animation. A run that is not asked for them
//! samples what its scene names and nothing more.

use anechoic_solver::problem::Problem;
use anechoic_solver::record::{Record, Snapshot};
use std::collections::BTreeSet;

/// Times of fields for ParaView, beside those of the scene.
const FIELDS: usize = 20;

/// Times of an animation.
const ANIMATION: usize = 80;

/// What is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sampling {
    /// Fields for ParaView.
    pub fields: bool,
    /// An animation.
    pub animation: bool,
}

/// The displacement on the body's nodes over time; empty where it was not asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frames {
    /// For ParaView: at the scene's own times, and evenly over the run.
    pub fields: Vec<Snapshot>,
    /// For an animation: evenly over the run.
    pub animation: Vec<Snapshot>,
}

impl Sampling {
    /// The problem of a scene, sampled at more times where that is asked for.
    pub fn of<const D: usize>(self, scene: &Problem<D>) -> Problem<D> {
        let mut problem = scene.clone();
        if self != Sampling::default() {
            let mut steps = own(scene);
            if self.fields {
                steps.extend(evenly(scene, FIELDS));
            }
            if self.animation {
                steps.extend(evenly(scene, ANIMATION));
            }
            let time = |step: &usize| *step as f64 * scene.dt;
            problem.probes.snapshot_times = steps.iter().map(time).collect();
        }
        problem
    }

    /// Takes what was asked for out of the record, and leaves in it what the scene names.
    pub fn part<const D: usize>(self, scene: &Problem<D>, record: &mut Record) -> Frames {
        if self == Sampling::default() {
            return Frames::default();
        }
        let all = std::mem::take(&mut record.snapshots);
        let at = |steps: &BTreeSet<usize>| -> Vec<Snapshot> {
            let asked = |s: &&Snapshot| steps.contains(&step_of(scene, s.time));
            all.iter().filter(asked).cloned().collect()
        };
        let own = own(scene);
        record.snapshots = at(&own);
        let mut frames = Frames::default();
        if self.fields {
            frames.fields = at(&own.iter().copied().chain(evenly(scene, FIELDS)).collect());
        }
        if self.animation {
            frames.animation = at(&evenly(scene, ANIMATION).collect());
        }
        frames
    }
}

/// The steps after which the scene itself is sampled.
fn own<const D: usize>(scene: &Problem<D>) -> BTreeSet<usize> {
    let times = scene.probes.snapshot_times.iter();
    times.map(|time| step_of(scene, *time)).collect()
}

/// Steps at even distances, the last of them the last of the run.
fn evenly<const D: usize>(scene: &Problem<D>, count: usize) -> impl Iterator<Item = usize> {
    let share = scene.last_time() / count as f64;
    (1..=count).map(move |i| step_of(scene, i as f64 * share))
}

/// The first step that ends no earlier than half a step before a time (s), as the solver samples.
fn step_of<const D: usize>(scene: &Problem<D>, time: f64) -> usize {
    (time / scene.dt - 0.5).ceil().max(0.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::point_source::PointSource;
    use anechoic_solver::record::{Cost, SeriesTable, Status};

    const BOTH: Sampling = Sampling {
        fields: true,
        animation: true,
    };

    /// A record with a snapshot at each time that the problem names, its number in a column's name.
    fn record(problem: &Problem<2>) -> Record {
        let snapshot = |time: &f64| Snapshot {
            time: *time,
            counts: [2, 2, 1],
            origin: [0.0; 3],
            spacing: [1.0, 1.0, 0.0],
            columns: Vec::new(),
        };
        Record {
            status: Status::Complete,
            receivers: SeriesTable::default(),
            energy: SeriesTable::default(),
            bodies: SeriesTable::default(),
            lines: Vec::new(),
            snapshots: problem.probes.snapshot_times.iter().map(snapshot).collect(),
            cost: Cost::default(),
        }
    }

    #[test]
    fn nothing_is_added_unless_it_is_asked_for() {
        let scene = PointSource::default().problem();
        let sampling = Sampling::default();
        assert_eq!(sampling.of(&scene).probes, scene.probes);
        let mut record = record(&scene);
        let before = record.clone();
        assert_eq!(sampling.part(&scene, &mut record), Frames::default());
        assert_eq!(record, before);
    }

    #[test]
    fn what_is_asked_for_is_parted_from_the_scenes_own() {
        let mut scene = PointSource::default().problem();
        // A time between two even ones, and one that the even ones have too.
        scene.probes.snapshot_times = vec![0.33, 5.0];
        let problem = BOTH.of(&scene);
        let times = &problem.probes.snapshot_times;
        assert!(times.windows(2).all(|w| w[1] - w[0] > 0.5 * scene.dt));
        assert_eq!(times.len(), ANIMATION + 1);
        let mut record = record(&problem);
        let frames = BOTH.part(&scene, &mut record);
        let times = |snapshots: &[Snapshot]| -> Vec<f64> {
            snapshots
                .iter()
                .map(|s| (s.time * 100.0).round() / 100.0)
                .collect()
        };
        assert_eq!(times(&record.snapshots), [0.33, 5.0]);
        assert_eq!(frames.animation.len(), ANIMATION);
        assert_eq!(frames.fields.len(), FIELDS + 1);
        let fields = times(&frames.fields);
        assert_eq!(fields[..3], [0.33, 0.5, 1.0]);
        assert_eq!(fields[FIELDS], scene.end_time);
    }
}
