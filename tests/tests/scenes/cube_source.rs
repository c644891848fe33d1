//! Gates of the cube: its claims on the gate's scene against the certified reference, computed here, and
//! what the program says of a scene in space where it can only do with a plane one.
//!
//! Mutations of the layer that fail the claims: psi not moved on; q_l with the other sign; cross terms
//! without psi; without e_2 or with U left out of the corner (see `methods/pml_space.rs`).

use anechoic::commands::{Options, compare};
use anechoic::error::CaseError;
use anechoic::prepare::{Request, Target};
use anechoic::scene_text;
use anechoic_reports::row::Verdict;

const CASE: &str = "cube-source";

#[test]
fn the_claims_hold_at_gate_size() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut options = Options::new(CASE, folder.path()).profile("gate");
    for method in ["fixed", "dashpot", "pml"] {
        options = options.method(method);
    }
    let finished = compare(&options).unwrap_or_else(|error| panic!("{error}"));
    let rows = &finished.study.rows;
    let of = |method: &str, place: &str| {
        let mut rows = rows.iter();
        let row = rows.find(|r| {
            (r.method.as_str(), r.metric.as_str(), r.place.as_str())
                == (method, "echo_ratio", place)
        });
        row.and_then(|row| row.value).expect("it was measured")
    };
    for group in ["A", "B", "C"] {
        let [layer, dashpot] = ["pml", "dashpot"].map(|method| of(method, group));
        println!("{group}: pml {layer:.5}, dashpot {dashpot:.3}");
        assert!(layer < 0.03 * dashpot);
    }
    let claimed: Vec<_> = rows.iter().filter(|row| row.accept.is_some()).collect();
    assert_eq!(claimed.len(), 6);
    for row in claimed {
        let (place, value) = (&row.place, row.value);
        assert_eq!(row.verdict, Some(Verdict::Pass), "{place}: {value:?}");
    }
}

/// The case with `sets`, prepared.
fn prepared(sets: &[&str]) -> Result<anechoic::prepare::Prepared, CaseError> {
    let request = Request {
        target: CASE.into(),
        profile: Some("gate".into()),
        sets: sets.iter().map(|set| (*set).to_owned()).collect(),
        ..Request::default()
    };
    Target::find(&request)?.prepare(Some("pml"))
}

#[test]
fn a_scene_in_space_is_written_down_and_refused_where_it_cannot_be() {
    let scene = prepared(&["receivers.A1.z_m=35"]).expect("it is well put");
    let text = scene_text::write(&scene);
    assert!(text.contains("z_m = 35.0") && text.contains("front = { method = \"pml\""));
    for (set, words) in [
        ("receivers.A1.z_m=235", "outside the mesh"),
        ("points.per_cell=4", "not a cube"),
        ("pml.static_load=follow", "in three dimensions"),
        ("time.mass=consistent", "lumped"),
    ] {
        let refused = prepared(&[set]).expect_err(set).to_string();
        assert!(refused.contains(words), "{set}: {refused}");
    }
    let plane = Request {
        target: "point-source".into(),
        sets: vec!["receivers.A1.z_m=5".into()],
        ..Request::default()
    };
    let refused = Target::find(&plane).expect("it exists").prepare(None);
    let refused = refused.expect_err("a plane has no z").to_string();
    assert!(refused.contains("the scene is plane"), "{refused}");
}
