//! Fields over time as the command line gives them: on request, and not otherwise.

use anechoic_tests::program::{anechoic, folder, narrow, read, run_folder};
use std::path::Path;
use vtkio::model::{Attribute, DataSet, Vtk};

const CASE: &str = "compression-1d";

/// Calls the program and insists on exit code 0.
#[track_caller]
fn passes(folder: &Path, arguments: &[&str]) -> String {
    let output = anechoic(folder, arguments);
    assert_eq!(
        output.code, 0,
        "{arguments:?}: {}{}",
        output.err, output.out
    );
    output.out
}

/// Largest component of the displacement in a file.
fn largest(path: &Path) -> f32 {
    let bytes = std::fs::read(path).expect("a file");
    let DataSet::UnstructuredGrid { mut pieces, .. } =
        Vtk::parse_xml(bytes.as_slice()).expect("a VTK file").data
    else {
        panic!("no unstructured grid");
    };
    let piece = pieces
        .remove(0)
        .into_loaded_piece_data(None)
        .expect("whole");
    let [Attribute::DataArray(vector)] = piece.data.point.as_slice() else {
        panic!("not one array at the nodes");
    };
    assert_eq!(vector.name, "displacement");
    let values: Vec<f32> = vector.data.cast_into().expect("numbers");
    assert_eq!(values.len(), piece.points.len());
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

#[test]
fn a_run_leaves_fields_where_they_are_asked_for() {
    let folder = folder();
    let run = ["run", CASE, "--method", "dashpot"];
    passes(folder.path(), &narrow(&run));
    let results = folder.path().join("results");
    let at = run_folder(&results, "dashpot");
    let record = read(&at.join("record.json"));
    assert!(!at.join("fields.pvd").exists() && !at.join("fields").exists());

    passes(folder.path(), &narrow(&[&run[..], &["--fields"]].concat()));
    // Same input, same place, same record.
    assert_eq!(run_folder(&results, "dashpot"), at);
    assert_eq!(read(&at.join("record.json")), record);
    let list = read(&at.join("fields.pvd"));
    let named: Vec<&str> = list
        .split("file=\"")
        .skip(1)
        .filter_map(|rest| rest.split('"').next())
        .collect();
    assert_eq!(named.len(), 20);
    let peaks: Vec<f32> = named.iter().map(|name| largest(&at.join(name))).collect();
    // The top moves by the pulse's area and stays there: 1 mm/s over half a second, 2/pi of it.
    let moved = 1e-3 * 0.5 * std::f32::consts::FRAC_2_PI;
    let last = peaks[peaks.len() - 1];
    assert!((last / moved - 1.0).abs() < 0.02, "{last}");

    passes(folder.path(), &narrow(&run));
    assert!(!at.join("fields.pvd").exists() && !at.join("fields").exists());
}

#[test]
fn a_comparison_leaves_an_animation_where_it_is_asked_for() {
    let folder = folder();
    let compare = ["compare", CASE, "--method", "dashpot"];
    let text = passes(
        folder.path(),
        &narrow(&[&compare[..], &["--animate"]].concat()),
    );
    assert!(text.contains("animation.gif"), "{text}");
    // The runs that it shows were solved with it.
    let results = folder.path().join("results");
    for method in ["fixed", "extended"] {
        assert!(run_folder(&results, method).is_dir());
    }
    let path = results.join(CASE).join("animation.gif");
    let bytes = std::fs::read(&path).expect("a file");
    let mut decoder = gif::DecodeOptions::new()
        .read_info(bytes.as_slice())
        .expect("a GIF");
    let mut frames = 0;
    while decoder.read_next_frame().expect("whole").is_some() {
        frames += 1;
    }
    assert_eq!(frames, 80);
    // One of earlier runs would not show the new ones.
    passes(folder.path(), &narrow(&compare));
    assert!(!path.exists());
}

/// Soil that flows has no displacement: what is written and animated is its velocity, and its pressure beside.
#[test]
fn soil_that_flows_leaves_velocities() {
    let folder = folder();
    let arguments = [
        "compare",
        "pipe-penetration",
        "--profile",
        "gate",
        "--method",
        "fixed",
        "--method",
        "pml",
        "--set",
        "pipe.depth=0.15",
        "--fields",
        "--animate",
    ];
    let output = anechoic(folder.path(), &arguments);
    assert_eq!(output.code, 0, "{}{}", output.err, output.out);
    assert!(output.out.contains("animation.gif"), "{}", output.out);
    let runs = folder.path().join("results/pipe-penetration/pml");
    let mut runs = std::fs::read_dir(runs).expect("runs of the method");
    let run = runs.next().expect("one").expect("an entry").path();
    let bytes = std::fs::read(run.join("fields/000.vtu")).expect("a file");
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("velocity") && text.contains("pressure"));
}
