//! Bad input is found before anything is solved, and the error says where it is and what is allowed.

use anechoic::commands::{Options, plan_compare, plan_run, show};
use anechoic::error::exit;
use anechoic::prepare::{Prepared, Request};
use anechoic::scene_text;
use std::path::{Path, PathBuf};

const CASE: &str = "compression-1d";

fn request(target: &str, sets: &[&str]) -> Request {
    Request {
        target: target.into(),
        sets: sets.iter().map(|&set| set.into()).collect(),
        ..Request::default()
    }
}

/// The error of a request, which must be one of usage or input.
fn refused(target: &str, sets: &[&str], method: Option<&str>) -> String {
    let error = show(&request(target, sets), method).expect_err("must be refused");
    assert_eq!(error.exit_code(), exit::USAGE, "{error}");
    error.to_string()
}

fn accepted(target: &str, sets: &[&str], method: Option<&str>) -> Prepared {
    show(&request(target, sets), method).unwrap_or_else(|error| panic!("{error}"))
}

#[track_caller]
fn says(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "`{word}` is missing in: {text}");
    }
}

/// A file with the text; the folder is removed at the end of the test.
fn file(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("my.toml");
    std::fs::write(&path, text).expect("a file in it");
    (folder, path)
}

fn refused_file(text: &str) -> String {
    let (_folder, path) = file(text);
    refused(&path.display().to_string(), &[], None)
}

#[test]
fn unknown_names_come_with_the_nearest() {
    says(
        &refused("compresion-1d", &[], None),
        &["case", "`compression-1d`"],
    );
    says(
        &refused(CASE, &[], Some("dashpott")),
        &["method", "`dashpot`"],
    );
    let mut wrong = request(CASE, &[]);
    wrong.profile = Some("papr".into());
    says(
        &show(&wrong, None).unwrap_err().to_string(),
        &["profile", "`paper`"],
    );
    let mut wrong = request(CASE, &[]);
    wrong.presets = vec!["liner".into()];
    says(
        &show(&wrong, None).unwrap_err().to_string(),
        &["preset", "`linear`"],
    );
    says(
        &refused(CASE, &["matrial.nu=0.3"], None),
        &["matrial.nu", "`material.nu`"],
    );
    says(
        &refused(CASE, &["dashpot.impedence=1"], Some("dashpot")),
        &["`impedance`"],
    );
    says(
        &refused(CASE, &["boundary.bottom.method=dashpt"], None),
        &["boundary.bottom.method", "`dashpot`"],
    );
    says(
        &refused(CASE, &["source.wavelet=half-sin"], None),
        &["`half-sine`", "\"sine-squared\""],
    );
}

#[test]
fn ranges_are_named() {
    for (set, allowed) in [
        ("grid.h_m=0", "value > 0"),
        ("grid.h_m=-1", "value > 0"),
        ("grid.h_m=nan", "value > 0"),
        ("body.width_m=-50", "value > 0"),
        ("material.nu=0.5", "-1 < value < 0.5"),
        ("material.nu=-1", "-1 < value < 0.5"),
        ("time.dt_s=0", "value > 0"),
        ("time.dt_s=-0.1", "value > 0"),
        ("time.end_s=inf", "value > 0"),
        ("solver.rel_tol=0.01", "0 < value <= 0.001"),
        ("solver.rel_tol=0", "0 < value <= 0.001"),
        ("points.per_cell=0", "1 <= value <= 100"),
    ] {
        let field = set.split('=').next().unwrap();
        says(&refused(CASE, &[set], None), &[field, set, allowed]);
    }
    says(
        &refused(CASE, &["dashpot.impedance=-1"], Some("dashpot")),
        &["boundary.bottom.impedance: -1 is out", "0 <= value <= 1e6"],
    );
}

#[test]
fn relations_between_fields_are_checked() {
    for (sets, words) in [
        (
            &["grid.h_m=60"][..],
            &["grid.h_m", "larger than the body's 50 m"][..],
        ),
        (&["points.per_cell=5"], &["5 is not a square", "1, 4, 9"]),
        (
            &["points.mode=moving"],
            &["points.transfer", "frozen", "\"affine\""],
        ),
        (
            &["receivers.A.y_m=50.5"],
            &["receiver A", "outside the mesh", "0 <= value <= 50"],
        ),
        (&["receivers.B.x_m=-1"], &["receiver B", "outside the mesh"]),
        (&["receivers=[]"], &["receivers", "empty"]),
        (
            &["source.frequency_Hz=0.05"],
            &["pulse lasts 10 s", "time.end_s = 5 s"],
        ),
        (&["time.dt_s=6"], &["time.dt_s", "longer than the run"]),
        (&["time.scheme=quasi-static"], &["time.scheme", "newmark"]),
    ] {
        says(&refused(CASE, sets, None), words);
    }
    for thickness in ["50", "60"] {
        says(
            &refused(
                CASE,
                &[&format!("damping-layer.thickness_m={thickness}")],
                Some("damping-layer"),
            ),
            &[
                "boundary.bottom.thickness_m",
                "leaves nothing of the body (50 m)",
            ],
        );
    }
}

#[test]
fn all_mistakes_come_at_once() {
    let text = refused(CASE, &["material.nu=0.6", "grid.h_m=-1", "time.dt=1"], None);
    says(
        &text,
        &["3 fields", "material.nu", "grid.h_m", "`time.dt_s`"],
    );
}

#[test]
fn a_file_is_named_with_its_line() {
    let text = refused_file("case = \"compression-1d\"\n\n[material]\nnu = 0.49\nE_pa = 1.0\n");
    says(&text, &["my.toml:5", "material.E_pa", "`material.E_Pa`"]);
    let text = refused_file("case = \"compression-1d\"\n[grid]\nh_m = \"fine\"\n");
    says(
        &text,
        &["my.toml:3", "grid.h_m", "expected a number", "\"fine\""],
    );
    let text = refused_file("case = \"compression-1d\"\n[material]\nnu = 0.7\n");
    says(&text, &["my.toml:3", "-1 < value < 0.5"]);
    let text = refused_file("case = \"compression-1d\"\nmaterial.nu = = 3\n");
    says(&text, &["my.toml:2:15"]);
    let text = refused_file("case = \"compression-1d\"\ngrid = 3\n");
    says(&text, &["my.toml:2", "grid.h_m"]);
    let text = refused_file("case = \"compression-1d\"\ngrid.h_m = { a = 1 }\n");
    says(&text, &["my.toml:2", "found a table"]);
    let text = refused_file("[grid]\nh_m = 1.0\n");
    says(&text, &["my.toml", "case ="]);
    let text = refused_file("case = 3\n");
    says(&text, &["my.toml:1", "case"]);
    let text = refused_file("case = \"compression-1d\"\n[boundary]\nbottom = \"dashpot\"\n");
    says(&text, &["my.toml:3", "boundary.bottom", "method"]);
    let text = refused_file(
        "case = \"compression-1d\"\n[boundary.bottom]\nmethod = \"dashpot\"\nimpedence = 2\n",
    );
    says(
        &text,
        &["my.toml:4", "boundary.bottom.impedence", "`impedance`"],
    );
    let text = refused_file(
        "case = \"compression-1d\"\n[[receivers]]\nname = \"A\"\nx_m = 1.0\ny_m = 70\n",
    );
    says(&text, &["my.toml:5", "receiver A", "outside the mesh"]);
    let text =
        refused_file("case = \"compression-1d\"\n[[receivers]]\nname = \"A_1\"\nx_m = 1.0\n");
    says(&text, &["my.toml:3", "not a name", "has no y_m"]);
    says(
        &refused("absent.toml", &[], None),
        &["absent.toml", "cannot be read"],
    );
}

#[test]
fn unknown_names_in_a_file_are_named_with_their_line() {
    for (text, words) in [
        (
            "case = \"compresion-1d\"",
            [":1: unknown case", "`compression-1d`"],
        ),
        (
            "\ncase = \"compression-1d\"\nprofile = \"gat\"",
            [":3: unknown profile", "`gate`"],
        ),
        (
            "case = \"compression-1d\"\npreset = [\"linaer\"]",
            [":2: unknown preset", "`linear`"],
        ),
        (
            "case = \"compression-1d\"\nprofil = \"gate\"",
            [":2: profil", "`profile`"],
        ),
    ] {
        says(&refused_file(text), &words);
    }
    // What the command line says lies over it.
    let (_folder, path) = file("case = \"compression-1d\"\nprofile = \"gat\"");
    let request = Request {
        target: path.display().to_string(),
        profile: Some("gate".into()),
        ..Request::default()
    };
    assert!(show(&request, None).is_ok());
}

#[test]
fn a_side_described_by_a_file_counts_unless_a_method_is_named() {
    let (_folder, path) = file(
        "case = \"compression-1d\"\n[boundary]\nbottom = { method = \"dashpot\", impedance = 2 }\n",
    );
    let path = path.display().to_string();
    let bottom = |prepared: &Prepared| prepared.scene.boundary().bottom.clone();
    let run = accepted(&path, &[], None);
    assert_eq!(run.method, "dashpot");
    assert_eq!(
        run.table["boundary"]["bottom"]["impedance"].as_float(),
        Some(2.0)
    );
    assert_eq!(
        bottom(&accepted(&path, &[], Some("extended"))).method,
        "extended"
    );
    assert!(
        bottom(&accepted(&path, &[], Some("dashpot")))
            .params
            .is_empty()
    );
    let plan = plan_compare(&Options::new(&path, Path::new("unused"))).unwrap();
    let described = plan.scenes.iter().find(|s| s.method == "dashpot").unwrap();
    assert_eq!(bottom(described), bottom(&run));
    assert_eq!(plan.scenes.len(), 5);
}

#[test]
fn several_methods_on_the_sides_are_joined_in_the_name() {
    let sets = [
        "boundary.bottom.method=dashpot",
        "boundary.left.method=extended",
    ];
    assert_eq!(accepted(CASE, &sets, None).method, "extended+dashpot");
    let free = ["boundary.bottom.method=free"];
    assert_eq!(accepted(CASE, &free, None).method, "free");
    let sides = ["boundary.left.method=free", "boundary.right.method=free"];
    assert_eq!(accepted(CASE, &sides, None).method, "free+roller");
    let mixed = |method: &str| {
        let sets = [
            "boundary.left.method=roller".to_owned(),
            format!("boundary.right.method={method}"),
            format!("boundary.bottom.method={method}"),
        ];
        let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
        accepted("point-source", &sets, None).method
    };
    assert_eq!(mixed("pml-stretched"), "roller+pml-stretched");
    assert_eq!(mixed("free"), "roller+free");
}

#[test]
fn assignments_are_laid_in_order_and_over_the_file() {
    let (_folder, path) =
        file("case = \"compression-1d\"\nprofile = \"paper\"\n[grid]\nh_m = 2.0\n");
    let path = path.display().to_string();
    let prepared = accepted(&path, &[], None);
    assert_eq!(prepared.profile, "paper");
    let problem = prepared.scene.posed().plane().unwrap();
    assert_eq!((problem.cell_size, problem.dt), (2.0, 0.01));
    let problem = accepted(&path, &["grid.h_m=5", "grid.h_m=0.5"], None)
        .scene
        .posed()
        .plane()
        .unwrap();
    assert_eq!((problem.cell_size, problem.dt), (0.5, 0.0025));
    // 13 cells fit into 50 m: the step follows the cell in use.
    let problem = accepted(CASE, &["grid.h_m=4"], None)
        .scene
        .posed()
        .plane()
        .unwrap();
    assert!((problem.dt - 0.005 * 50.0 / 13.0).abs() < 1e-15);
    let problem = accepted(&path, &["time.dt_s=0.004"], None)
        .scene
        .posed()
        .plane()
        .unwrap();
    assert_eq!(problem.dt, 0.004);
}

#[test]
fn a_methods_parameter_reaches_every_side_that_uses_it() {
    let sets = [
        "boundary.left.method=dashpot",
        "boundary.bottom.method=dashpot",
        "dashpot.impedance=0.5",
    ];
    let prepared = accepted(CASE, &sets, None);
    let sides = prepared.scene.boundary();
    assert_eq!(sides.left, sides.bottom);
    assert_eq!(
        prepared.table["boundary"]["left"]["impedance"].as_float(),
        Some(0.5)
    );
    assert!(sides.right.params.is_empty());
    says(
        &refused(CASE, &["dashpot.impedance=0.5"], None),
        &["no side uses that method"],
    );

    let mut options = Options::new(CASE, Path::new("unused")).set("dashpot.impedance=0.5");
    let plan = plan_compare(&options).unwrap();
    for scene in &plan.scenes {
        let changed = !scene.scene.boundary().bottom.params.is_empty();
        assert_eq!(
            changed,
            ["dashpot", "damping-layer", "pml"].contains(&scene.method.as_str())
        );
    }
    options.methods = vec!["fixed".into()];
    says(
        &plan_compare(&options).unwrap_err().to_string(),
        &["dashpot.impedance=0.5"],
    );
}

#[test]
fn what_show_writes_is_the_same_scene_again() {
    for method in [
        None,
        Some("dashpot"),
        Some("damping-layer"),
        Some("pml"),
        Some("extended"),
    ] {
        for profile in ["gate", "quick", "paper"] {
            let mut asked = request(
                CASE,
                &["source.wavelet=sine-squared", "material.E_Pa=1.23456789e5"],
            );
            asked.profile = Some(profile.into());
            let shown = show(&asked, method).unwrap();
            let (_folder, path) = file(&scene_text::write(&shown));
            let again = accepted(&path.display().to_string(), &[], None);
            assert_eq!(again.table, shown.table);
            assert_eq!(again.hash(), shown.hash());
            assert_eq!((again.profile, again.method), (shown.profile, shown.method));
        }
    }
}

#[test]
fn the_hash_follows_the_values_and_nothing_else() {
    let hash = |sets: &[&str]| accepted(CASE, sets, None).hash();
    assert_eq!(hash(&[]), hash(&["grid.h_m=1"]));
    assert_ne!(hash(&[]), hash(&["grid.h_m=0.5"]));
    assert_ne!(hash(&[]), accepted(CASE, &[], Some("dashpot")).hash());
}

#[test]
fn a_filter_chooses_methods_or_matches_nothing() {
    let plan = |filter: &str| {
        let mut options = Options::new(CASE, Path::new("unused"));
        options.filter = Some(filter.into());
        plan_compare(&options).map(|plan| -> Vec<String> {
            plan.scenes.into_iter().map(|scene| scene.method).collect()
        })
    };
    // Ratios are taken over the standard run, so it is always there.
    assert_eq!(plan("dashpot").unwrap(), ["fixed", "dashpot"]);
    assert_eq!(plan("extended/residual").unwrap(), ["fixed", "extended"]);
    assert_eq!(plan("residual").unwrap().len(), 5);
    // Its claims are certified by the extended run.
    assert_eq!(plan("pml/residual").unwrap(), ["fixed", "pml", "extended"]);
    let error = plan("residuum").unwrap_err();
    assert_eq!(error.exit_code(), exit::USAGE);
    says(&error.to_string(), &["matches nothing", "`residual`"]);
}

#[test]
fn run_takes_one_method() {
    let options = Options::new(CASE, Path::new("unused"))
        .method("fixed")
        .method("dashpot");
    assert_eq!(plan_run(&options).unwrap_err().exit_code(), exit::USAGE);
}
