//! What a certified reference depends on, as canonical text and its hash.
//!
//! Everything that the receivers' series depend on is in it, down to the solver's tolerance. Not in
//! it: the end of the run (a longer reference serves a shorter run), what else is sampled, and which
//! linear solver reaches the tolerance.

use super::causality::{EXTENDED, sides};
use crate::posed::{Posed, either};
use anechoic_solver::boundary::{SideMethod, Value as Param};
use anechoic_solver::problem::{Drive, MassKind, Problem};
use serde::Serialize;
use sha2::{Digest, Sha256};
use toml::{Table, Value};

/// The problem as a table, extended sides without their thickness.
pub fn table(problem: &Posed) -> Table {
    either!(problem, problem => table_of(problem))
}

/// The hash of a problem.
pub fn hash_of(problem: &Posed) -> String {
    hash(&table(problem))
}

fn table_of<const D: usize>(problem: &Problem<D>) -> Table {
    let mut table = Table::new();
    let mut put = |key: &str, value: Value| {
        table.insert(key.to_owned(), value);
    };
    put("target_lower_m", numbers(problem.target.lower));
    put("target_upper_m", numbers(problem.target.upper));
    put("cell_m", problem.cell_size.into());
    put("basis", word(&problem.basis));
    put("scheme", word(&problem.scheme));
    // what references made before there was a choice were made with is not said
    if problem.mass != MassKind::default() {
        put("mass", word(&problem.mass));
    }
    put("dt_s", problem.dt.into());
    put("points", word(&problem.point_mode));
    put("transfer", word(&problem.transfer));
    put("points_per_cell", (problem.points_per_cell as i64).into());
    put("E_Pa", problem.material.youngs_modulus.into());
    put("nu", problem.material.poissons_ratio.into());
    put("rho_kg_m3", problem.material.density.into());
    if problem.aspect != 1.0 {
        put("aspect", problem.aspect.into());
    }
    if let Some(ratio) = problem.inclusion {
        put("inclusion", ratio.into());
    }
    if let Some(gap) = problem.face_gap {
        put("face_gap", gap.into());
    }
    put("rel_tol", problem.rel_tol.into());
    for side in sides::<D>() {
        let method = &problem.sides[side.axis][usize::from(side.upper)];
        put(side.name(), of_side(method));
    }
    let drives = problem.drives.iter().map(of_drive).collect();
    put("drives", Value::Array(drives));
    let receivers = problem.probes.receivers.iter().map(|receiver| {
        let mut entry = Table::new();
        entry.insert("name".into(), receiver.name.clone().into());
        entry.insert("place_m".into(), numbers(receiver.place));
        Value::Table(entry)
    });
    put("receivers", Value::Array(receivers.collect()));
    table
}

/// First 16 hexadecimal digits of the SHA-256 of the table's text.
pub fn hash(table: &Table) -> String {
    let digest = Sha256::digest(table.to_string().as_bytes());
    digest[..8]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect()
}

fn numbers<const D: usize>(values: [f64; D]) -> Value {
    Value::Array(values.map(Value::Float).to_vec())
}

/// The name that a choice has in scenes.
fn word(choice: &impl Serialize) -> Value {
    Value::try_from(choice).expect("choices are plain words")
}

fn of_side(method: &SideMethod) -> Value {
    let mut table = Table::new();
    table.insert("method".into(), method.method.clone().into());
    for (key, value) in &method.params {
        if method.method == EXTENDED && key == "thickness_m" {
            continue;
        }
        let value = match value {
            Param::Number(x) => Value::Float(*x),
            Param::Text(text) => Value::String(text.clone()),
        };
        table.insert(key.clone(), value);
    }
    Value::Table(table)
}

fn of_drive<const D: usize>(drive: &Drive<D>) -> Value {
    let mut table = Table::new();
    let pulse = match drive {
        Drive::SideVelocity { side, pulse } => {
            table.insert("velocity_of".into(), side.name().into());
            pulse
        }
        Drive::PointForce {
            place,
            direction,
            pulse,
        } => {
            table.insert("force_at_m".into(), numbers(*place));
            table.insert("direction".into(), numbers(*direction));
            pulse
        }
    };
    table.insert("wavelet".into(), word(&pulse.wavelet));
    table.insert("amplitude".into(), pulse.amplitude.into());
    table.insert("frequency_Hz".into(), pulse.frequency.into());
    table.insert("t0_s".into(), pulse.t0.into());
    Value::Table(table)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certified::causality::buffered;
    use crate::scene::Scene;
    use crate::scenes::point_source::PointSource;

    fn of(change: impl FnOnce(&mut PointSource)) -> String {
        let mut scene = PointSource::default();
        change(&mut scene);
        hash(&table(&scene.extended().unwrap()))
    }

    #[test]
    fn only_what_matters_changes_the_hash() {
        let hash_of_default = of(|_| ());
        assert_eq!(of(|s| s.time.end_s = 7.0), hash_of_default);
        assert_eq!(of(|s| s.t1_s = 3.0), hash_of_default);
        assert_eq!(
            of(|s| s.boundary.left = SideMethod::new("dashpot")),
            hash_of_default
        );
        let changes: [fn(&mut PointSource); 10] = [
            |s| s.material.inclusion = Some(10.0),
            |s| s.grid.h_m = 10.0,
            |s| s.grid.aspect = Some(2.0),
            |s| s.points.face_gap = Some(0.1),
            |s| s.solver.rel_tol = 1e-8,
            |s| s.material.nu = 0.3,
            |s| s.source.x_m = 1140.0,
            |s| s.source.frequency = 3.0,
            |s| s.receivers[3].y_m = -60.0,
            |s| s.boundary.left = SideMethod::new("roller"),
        ];
        let mut seen = vec![hash_of_default];
        for change in changes {
            let hash = of(change);
            assert!(!seen.contains(&hash));
            seen.push(hash);
        }
    }

    #[test]
    fn the_buffer_is_not_part_of_it() {
        let problem = PointSource::default().extended().unwrap();
        assert_eq!(table(&problem), table(&buffered(&problem, 1.2)));
    }
}
