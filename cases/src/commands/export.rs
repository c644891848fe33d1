//! `show --export`: a scene as plain files, for programs that solve it themselves.
//!
//! | file | holds |
//! |---|---|
//! | `README.txt` | what is to be solved and what the other program writes |
//! | `scene.toml` | the scene; `anechoic score scene.toml series.csv` judges by it |
//! | `mesh.csv` | the body's cells as we take them |
//! | `materials.csv` | elastic constants, density, speeds |
//! | `load.csv` | what sets the body in motion, at our steps |
//! | `receivers_places.csv` | where motion is recorded |
//! | `reference.csv` | the receivers' motion without echo, where it is known |

use crate::certified::library::Library;
use crate::error::CaseError;
use crate::judge::references::at_times;
use crate::prepare::Prepared;
use crate::scene::{Quantity, Reference, Role};
use crate::scene_text;
use crate::store::{series_csv, write_file};
use anechoic_solver::geometry::fitted_cell;
use anechoic_solver::problem::{Drive, Problem};
use anechoic_solver::record::{Column, SeriesTable};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// The file of the reference.
const REFERENCE: &str = "reference.csv";

/// A scene that was written.
#[derive(Debug)]
pub struct Exported {
    /// Its files.
    pub files: Vec<PathBuf>,
    /// Name of the reference, or why there is none.
    pub reference: Result<&'static str, String>,
}

/// Writes the scene into `folder`; certified references are looked for in `results` as well.
///
/// # Errors
/// [`CaseError::Usage`] for a folder that cannot be made, [`CaseError::Storage`], and what is wrong
/// with a stored reference.
pub fn export(scene: &Prepared, folder: &Path, results: &Path) -> Result<Exported, CaseError> {
    std::fs::create_dir_all(folder).map_err(|error| {
        CaseError::Usage(format!(
            "--export {}: cannot write there: {error}",
            folder.display()
        ))
    })?;
    let Some(problem) = scene.scene.posed().plane() else {
        return Err(CaseError::Usage(format!(
            "--export: {} is three-dimensional, and meshes are written for plane strain alone",
            scene.info.name
        )));
    };
    let steps = scene.bill.steps;
    let times: Vec<f64> = (0..=steps).map(|step| step as f64 * problem.dt).collect();
    let reference = without_echo(scene, &problem, &times, results)?;
    let said = reference.as_ref().map(|r| r.name).map_err(String::clone);
    let mut files = vec![
        ("README.txt", readme(scene, &problem, &said).into_bytes()),
        ("scene.toml", scene_text::write(scene).into_bytes()),
        ("mesh.csv", mesh(&problem).into_bytes()),
        ("materials.csv", materials(&problem).into_bytes()),
        ("load.csv", series_csv(&load(&problem, &times))?),
        ("receivers_places.csv", receivers(&problem).into_bytes()),
    ];
    match reference {
        Ok(reference) => files.push((REFERENCE, series_csv(&series(&reference, &times))?)),
        // One of an earlier export would be that of another scene.
        Err(_) => drop(std::fs::remove_file(folder.join(REFERENCE))),
    }
    let mut paths = Vec::new();
    for (name, content) in files {
        let path = folder.join(name);
        write_file(&path, &content)?;
        paths.push(path);
    }
    Ok(Exported {
        files: paths,
        reference: said,
    })
}

/// The motion without echo: a closed form, else a certified reference that is stored.
fn without_echo(
    scene: &Prepared,
    problem: &Problem<2>,
    times: &[f64],
    results: &Path,
) -> Result<Result<Reference, String>, CaseError> {
    let closed = match scene.scene.references(times) {
        Ok(all) => all.into_iter().find(|r| r.role == Role::NoEcho),
        Err(why) => return Ok(Err(why)),
    };
    if let Some(reference) = closed {
        return Ok(Ok(reference));
    }
    let case = scene.info.name;
    let Some(extended) = scene.scene.extended() else {
        return Ok(Err("the scene has none".to_owned()));
    };
    Ok(match Library::of_results(results).find(case, &extended)? {
        Some(found) => {
            // Of a longer reference the samples of this run.
            let end = times.len().min(found.receivers.times.len());
            at_times(&found, &times[..end.max(1)])
                .and_then(|r| found.about.serves(problem.last_time()).map(|()| r))
        }
        None => Err(format!(
            "it has to be solved for: `anechoic reference` with the same scene does, and so does the first `anechoic compare {case}`"
        )),
    })
}

/// The reference as a table.
fn series(reference: &Reference, times: &[f64]) -> SeriesTable {
    let unit = match reference.quantity {
        Quantity::Displacement => "m",
        Quantity::Velocity => "m/s",
    };
    let columns = reference.receivers.iter().flat_map(|(name, components)| {
        ["x", "y"]
            .into_iter()
            .zip(components)
            .map(move |(axis, values)| Column {
                name: format!("{name}_{}{axis}", reference.quantity.letter()),
                unit: unit.to_owned(),
                values: values.clone(),
            })
    });
    SeriesTable {
        columns: columns.collect(),
        times: times.to_vec(),
    }
}

/// What sets the body in motion.
fn load(problem: &Problem<2>, times: &[f64]) -> SeriesTable {
    let column = |name: String, unit: &str, value: &dyn Fn(f64) -> f64| Column {
        name,
        unit: unit.to_owned(),
        values: times.iter().map(|t| value(*t)).collect(),
    };
    let columns = problem
        .drives
        .iter()
        .enumerate()
        .flat_map(|(index, drive)| match drive {
            Drive::SideVelocity { side, pulse } => {
                let (name, axis) = (side.name(), ["x", "y"][side.axis]);
                let lasts = |t: f64| t <= pulse.end() * (1.0 + 1e-9);
                vec![
                    column(format!("{name}_v{axis}"), "m/s", &|t| pulse.value(t)),
                    column(format!("{name}_prescribed"), "1", &|t| {
                        f64::from(u8::from(lasts(t)))
                    }),
                ]
            }
            Drive::PointForce {
                place,
                direction,
                pulse,
            } => {
                let force = format!("F{}", index + 1);
                vec![
                    column(format!("{force}_x"), "m", &|_| place[0]),
                    column(format!("{force}_y"), "m", &|_| place[1]),
                    column(format!("{force}_fx"), "N/m", &|t| {
                        direction[0] * pulse.value(t)
                    }),
                    column(format!("{force}_fy"), "N/m", &|t| {
                        direction[1] * pulse.value(t)
                    }),
                ]
            }
        });
    SeriesTable {
        columns: columns.collect(),
        times: times.to_vec(),
    }
}

/// The body's cells, row by row from the lower left one.
fn mesh(problem: &Problem<2>) -> String {
    let target = &problem.target;
    let h = fitted_cell(target, problem.edges());
    let count =
        |axis: usize| ((target.upper[axis] - target.lower[axis]) / h[axis]).round() as usize;
    let mut text = String::from("cell,x_min_m,x_max_m,y_min_m,y_max_m\n");
    let (columns, rows) = (count(0), count(1));
    for row in 0..rows {
        for column in 0..columns {
            let edge = |axis: usize, i: usize| target.lower[axis] + i as f64 * h[axis];
            let _ = writeln!(
                text,
                "{},{:?},{:?},{:?},{:?}",
                row * columns + column,
                edge(0, column),
                edge(0, column + 1),
                edge(1, row),
                edge(1, row + 1)
            );
        }
    }
    text
}

fn materials(problem: &Problem<2>) -> String {
    let body = ("body", problem.material);
    let included = problem.inclusion.map(|ratio| {
        let name = "middle third of the body along each axis";
        (name, problem.material.stiffened(ratio))
    });
    let mut text = String::from("region,model,E_Pa,nu,rho_kg_m3,c_p_m_s,c_s_m_s\n");
    for (region, m) in [body].into_iter().chain(included) {
        let _ = writeln!(
            text,
            "{region},linear-elastic-plane-strain,{:?},{:?},{:?},{:?},{:?}",
            m.youngs_modulus,
            m.poissons_ratio,
            m.density,
            m.p_speed(),
            m.s_speed()
        );
    }
    text
}

fn receivers(problem: &Problem<2>) -> String {
    let mut text = String::from("name,x_m,y_m\n");
    for receiver in &problem.probes.receivers {
        let [x, y] = receiver.place;
        let _ = writeln!(text, "{},{x:?},{y:?}", receiver.name);
    }
    text
}

/// What is to be solved and what comes back.
fn readme(scene: &Prepared, problem: &Problem<2>, reference: &Result<&str, String>) -> String {
    let info = scene.info;
    let mut text = format!(
        "{}: {}\n{}\n\n{}\n\n",
        info.name, info.title, info.source, info.summary
    );
    text += "Conventions: SI units, plane strain, unit thickness (forces per metre), x to the right,\ny up. The body is at rest at t = 0.\n\n";
    text +=
        "Sides of the body as the scene has them; which ends are modelled, and how, is yours:\n";
    for (side, method) in scene.scene.boundary().named() {
        let _ = writeln!(text, "  {side:<8} {}", method.method);
    }
    text += "\nFiles\n";
    for (name, holds) in [
        ("scene.toml", "the scene, every field with its unit"),
        (
            "mesh.csv",
            "the body's cells as we take them; yours may be others",
        ),
        ("materials.csv", "elastic constants, density, wave speeds"),
        ("load.csv", "what sets the body in motion, at our steps"),
        ("receivers_places.csv", "where motion is recorded"),
    ] {
        let _ = writeln!(text, "  {name:<22} {holds}");
    }
    let _ = match reference {
        Ok(name) => writeln!(
            text,
            "  {REFERENCE:<22} the receivers' motion without echo ({name})"
        ),
        Err(why) => writeln!(text, "\nThere is no {REFERENCE}: {why}."),
    };
    text += "\nLoad\n";
    for (index, drive) in problem.drives.iter().enumerate() {
        let (what, pulse) = match drive {
            Drive::SideVelocity { side, pulse } => (
                format!(
                    "the normal velocity of the side `{}`, positive along the axis, prescribed while `{0}_prescribed_1` is 1; the side is free afterwards",
                    side.name()
                ),
                pulse,
            ),
            Drive::PointForce { pulse, .. } => {
                (format!("F{}: a force at (x, y)", index + 1), pulse)
            }
        };
        let _ = writeln!(
            text,
            "  {what}; between the lines of the file it is {:?}, amplitude {:?}, frequency {:?} Hz, t0 {:?} s",
            pulse.wavelet, pulse.amplitude, pulse.frequency, pulse.t0
        );
    }
    let _ = write!(
        text,
        "\nWhat to write: series.csv\n  t_s, then NAME_ux_m and NAME_uy_m of every receiver, in any order; NAME_vx_m_s and NAME_vy_m_s\n  of all of them or of none (then they are central differences). Times rise from 0 to {:?} s at\n  least, in steps of at most {:?} s; those between ours are interpolated linearly. Every number is\n  finite. The header for this scene:\n\n  {}\n",
        scene.bill.steps as f64 * problem.dt,
        problem.dt,
        header(problem)
    );
    text += "\nThen\n  anechoic score scene.toml series.csv --name MINE [--method METHOD]\njudges it by the same rows as ours and shows it in the report beside them. With --method (one of\n`anechoic list`) its boundary counts as a model of that method, whose claims then judge it.\n";
    text
}

fn header(problem: &Problem<2>) -> String {
    let receivers = problem.probes.receivers.iter();
    let columns = receivers.map(|r| format!("{0}_ux_m,{0}_uy_m", r.name));
    format!("t_s,{}", columns.collect::<Vec<_>>().join(","))
}
