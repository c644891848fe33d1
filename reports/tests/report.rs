//! The report page of a made-up study: every row and figure is there, failures are not hidden,
//! nothing is fetched.
//!
//! With `ANECHOIC_PICTURES=DIR` in the environment the page is also written there, to look at.

use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::convergence::{Convergence, Curve, Level, Refinement};
use anechoic_reports::html::report;
use anechoic_reports::judge::{Measurement, cost_measurements, judge};
use anechoic_reports::plot::{BarPlot, Bars, Line, SpaceTimePlot, TracePanel, TracePlot};
use anechoic_reports::provenance::Provenance;
use anechoic_reports::ranking::{Floor, Ranking};
use anechoic_reports::study::{Figure, Finding, LedgerEntry, RunSummary, Study, Upshot};
use anechoic_reports::table::convergence_table;
use anechoic_solver::record::{Cost, SpaceTime, Status};

const METHODS: [(&str, f64, f64); 4] = [
    ("roller", 1.0, 0.94),
    ("dashpot", 0.0061, 0.96),
    ("damping-layer", 0.089, 0.99),
    ("pml", 0.0026, 1.42),
];

fn claim(method: &str, place: &str, max: f64, evidence: Evidence, why: &str) -> Claim {
    Claim {
        method: method.to_owned(),
        metric: "residual".to_owned(),
        place: place.to_owned(),
        accept: Accept::at_most(max),
        evidence,
        why: why.to_owned(),
    }
}

fn claims() -> Vec<Claim> {
    use Evidence::{Certified, Paper, Regression};
    let exact = "a dashpot is exact in one dimension; one cell of mass is spread over two";
    let layer = "20 cells with R = 1e-6: what is left is the discrete layer's own reflection";
    vec![
        claim("dashpot", "A", 0.01, Certified, exact),
        claim("dashpot", "B", 0.005, Certified, exact),
        claim("pml", "A", 0.005, Certified, layer),
        claim("pml", "C", 0.005, Certified, layer),
        claim(
            "damping-layer",
            "A",
            0.15,
            Paper,
            "printed as \"below 15 %\" <at t = 3 s>",
        ),
        claim(
            "pml",
            "A",
            0.0027,
            Regression,
            "the value of the last release",
        ),
    ]
}

fn cost(cpu_s: f64) -> Cost {
    Cost {
        steps: 1000,
        newton_iterations: 1000,
        iterations: 0,
        unknowns: 10_404,
        points: 10_000,
        cpu_s,
        wall_s: 1.02 * cpu_s,
        peak_bytes: 31_000_000,
        linear_solver: "direct: 142 unknowns".to_owned(),
    }
}

fn run(method: &str, status: Status, cpu_s: f64) -> RunSummary {
    RunSummary {
        method: method.to_owned(),
        status,
        cost: Some(cost(cpu_s)),
        provenance: Provenance {
            version: "0.1.0".to_owned(),
            revision: "5775b0f".to_owned(),
            dirty: method == "pml",
            sources: "c0ffee00c0ffee00".to_owned(),
            compiler: "rustc 1.95.0".to_owned(),
            threads: 2,
            input_hash: "9f86d081884c7d65".to_owned(),
        },
    }
}

fn measurements() -> Vec<Measurement> {
    let mut all = Vec::new();
    for (method, echo, cpu_s) in METHODS {
        for (metric, place, share) in [
            ("residual", "A", 1.0),
            ("residual", "B", 0.9),
            ("echo_ratio", "A", 1.0),
            ("echo_ratio", "B", 0.9),
        ] {
            for evidence in [Evidence::Certified, Evidence::Paper, Evidence::Regression] {
                let wanted = metric == "residual" || evidence == Evidence::Certified;
                if !wanted {
                    continue;
                }
                all.push(Measurement {
                    method: method.to_owned(),
                    metric: metric.to_owned(),
                    place: place.to_owned(),
                    value: Ok(share * echo),
                    unit: "1".to_owned(),
                    against: Some((evidence, "extended column".to_owned())),
                });
            }
        }
        all.extend(cost_measurements(method, &cost(cpu_s)));
    }
    all
}

fn figures() -> Vec<Figure> {
    let times: Vec<f64> = (0..=500).map(|i| f64::from(i) * 0.01).collect();
    let pulse = |t: f64| (-((t - 1.0) / 0.2).powi(2)).exp();
    let line = |name: &str, echo: f64| Line {
        name: name.to_owned(),
        x: times.clone(),
        y: times
            .iter()
            .map(|t| pulse(*t) - echo * pulse(t - 2.0))
            .collect(),
    };
    let traces = TracePlot {
        quantity: "velocity".to_owned(),
        unit: "m/s".to_owned(),
        panels: vec![TracePanel {
            title: "A (height 50 m)".to_owned(),
            reference: Some(line("extended column", 0.0)),
            lines: METHODS.iter().map(|(m, echo, _)| line(m, *echo)).collect(),
        }],
    };
    let bars = BarPlot {
        methods: METHODS.iter().map(|(m, ..)| (*m).to_owned()).collect(),
        echo: Bars {
            title: "Echo ratio (bar: mean, mark: worst)".to_owned(),
            unit: String::new(),
            values: METHODS
                .iter()
                .map(|(_, echo, _)| Some(0.95 * echo))
                .collect(),
        },
        worst: METHODS.iter().map(|(_, echo, _)| Some(*echo)).collect(),
        floor: Some(1e-3),
        costs: vec![Bars {
            title: "CPU time".to_owned(),
            unit: "s".to_owned(),
            values: METHODS.iter().map(|(_, _, cpu)| Some(*cpu)).collect(),
        }],
    };
    let positions: Vec<f64> = (0..=50).map(f64::from).collect();
    let field = |echo: f64| SpaceTime {
        name: "vy".to_owned(),
        unit: "m/s".to_owned(),
        positions: positions.clone(),
        axis: "height y".to_owned(),
        times: times.clone(),
        values: times
            .iter()
            .flat_map(|t| {
                positions.iter().map(move |y| {
                    let down = pulse(t - (50.0 - y) / 60.0);
                    let up = pulse(t - (50.0 + y) / 60.0);
                    -down + echo * up
                })
            })
            .collect(),
    };
    let space_time = SpaceTimePlot {
        quantity: "velocity".to_owned(),
        fields: METHODS
            .iter()
            .map(|(m, echo, _)| ((*m).to_owned(), field(*echo)))
            .collect(),
        guides: vec![],
        limit: None,
    };
    let drawn = "plausible data can be drawn";
    vec![
        Figure::of_lines(
            "Velocity at the receivers",
            "The roller sends the pulse back; the other methods follow the reference.",
            &traces.draw().expect(drawn),
        )
        .expect(drawn),
        Figure::of_lines(
            "Echo and cost",
            "The shorter the bar, the less comes back.",
            &bars.draw().expect(drawn),
        )
        .expect(drawn),
        Figure::of_field(
            "Waves in space and time",
            "An echo is a band that rises from the base.",
            &space_time.draw().expect(drawn),
        )
        .expect(drawn),
    ]
}

/// `rel_l2` of the column on three levels, the finest of which failed at B.
fn convergence() -> Convergence {
    let levels = [4.0, 2.0, 1.0].map(|value| Level { value, size: value });
    let failed = Err("the run failed".to_owned());
    Convergence {
        over: "grid.h_m".to_owned(),
        method: "fixed".to_owned(),
        levels: levels.to_vec(),
        curves: vec![
            Curve::new("rel_l2", "A", &levels, vec![Ok(0.16), Ok(0.04), Ok(0.01)]),
            Curve::new("rel_l2", "B", &levels, vec![Ok(0.16), Ok(0.04), failed]),
        ],
    }
}

fn study() -> Study {
    let rows = judge("compression-1d", "quick", &measurements(), &claims());
    let floor = Floor {
        value: 1e-3,
        how: "change of the reference under a larger buffer and a tenth of the tolerance"
            .to_owned(),
    };
    let mut runs: Vec<RunSummary> = METHODS
        .iter()
        .map(|(method, _, cpu)| run(method, Status::Complete, *cpu))
        .collect();
    runs.push(run("extended", Status::Cancelled, 0.5));
    let error = "velocity is not finite in step 412 (t = 2.06 s)".to_owned();
    runs.push(run("pml-stretched", Status::Failed(error), 0.2));
    Study {
        case: "compression-1d".to_owned(),
        title: "Compression wave in a column".to_owned(),
        summary: "A half-sine velocity at the top of a 50 m column; its base absorbs or reflects."
            .to_owned(),
        profile: "quick".to_owned(),
        command: "anechoic compare compression-1d --profile quick".to_owned(),
        ranking: Some(Ranking::from_rows(&rows, "echo_ratio", Some(floor))),
        rows,
        upshot: Some(Upshot::Convergence(Refinement {
            studies: vec![convergence()],
            budget: None,
        })),
        runs,
        ledger: vec![
            LedgerEntry {
                finding: Finding::Differs,
                place: "section 3.1".to_owned(),
                note: "The printed wave speed of 63 m/s needs a Poisson's ratio of 0.49, not 0.3."
                    .to_owned(),
            },
            LedgerEntry {
                finding: Finding::UnderSpecified,
                place: "Fig. 5".to_owned(),
                note: "The end of the damping layer is not given; a free end fits.".to_owned(),
            },
            LedgerEntry {
                finding: Finding::Reproduced,
                place: "Fig. 4".to_owned(),
                note: "The dashpot leaves no visible reflection.".to_owned(),
            },
        ],
        notes: vec!["the picture `echo` could not be made".to_owned()],
        figures: figures(),
    }
}

#[test]
fn every_row_and_figure_is_on_the_page() {
    let study = study();
    let page = report(&study);
    if let Ok(folder) = std::env::var("ANECHOIC_PICTURES") {
        std::fs::write(format!("{folder}/report.html"), &page).expect("the folder exists");
    }
    let rows = page.matches("<tr").count();
    // Header rows: verdicts twice, ranking, convergence, ledger, cost, provenance, measurements.
    let expected = study.rows.len() + 4 + 2 + 3 + 2 * study.runs.len() + 8;
    assert_eq!(rows, expected);
    assert_eq!(page.matches("<figure").count(), 3);
    assert_eq!(page.matches("<svg").count(), 2);
    assert_eq!(page.matches("data:image/png;base64,").count(), 1);
    for row in study.rows.iter().filter(|r| r.verdict.is_some()) {
        let why = row
            .why
            .replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
            .replace('"', "&quot;");
        assert!(page.contains(&why), "{why}");
    }
    for entry in &study.ledger {
        assert!(page.contains(entry.finding.name()));
    }
    for run in &study.runs {
        assert!(page.contains(&run.provenance.input_hash));
    }
}

#[test]
fn verification_stands_before_and_apart_from_the_rest() {
    let page = report(&study());
    let apart = page.find("Comparisons that do not verify").expect("a part");
    let verdicts = page.find("<h2>Verdicts").expect("a part");
    let ranking = page.find("<h2>Ranking").expect("a part");
    assert!(verdicts < apart && apart < ranking);
    let (verification, other) = (&page[verdicts..apart], &page[apart..ranking]);
    assert!(verification.contains("certified") && !verification.contains(">paper"));
    assert!(other.contains(">paper") && other.contains(">regression"));
    assert!(!other.contains(">certified"));
    // The tally counts verification only: pml C was never measured.
    assert!(verification.contains("1 not evaluated") && verification.contains("1 fail"));
}

#[test]
fn failures_and_gaps_are_shown() {
    let page = report(&study());
    assert!(page.contains("velocity is not finite in step 412"));
    assert!(page.contains("stopped before its end"));
    assert!(page.contains("residual of pml at C was not measured"));
    assert!(page.contains("dirty"));
}

#[test]
fn nothing_is_fetched() {
    let page = report(&study());
    for outside in [
        "<link",
        "<script",
        "src=\"http",
        "url(",
        "@import",
        "href=\"http",
    ] {
        assert!(!page.contains(outside), "{outside}");
    }
}

#[test]
fn errors_stand_beside_their_order() {
    let page = report(&study());
    assert!(page.contains("grid.h_m=4") && page.contains("2.00, 2.00"));
    let text = convergence_table(&convergence());
    let line = |at: &str| {
        let mut lines = text.lines();
        lines
            .find(|line| line.contains(&format!(" {at} ")))
            .expect("a line")
            .to_owned()
    };
    assert!(line("A").contains("0.160") && line("A").contains("2.00 (2.00 to 2.00)"));
    assert!(line("B").contains("the run failed"), "{text}");
}

#[test]
fn an_empty_study_claims_nothing() {
    let empty = Study {
        rows: vec![],
        ranking: None,
        upshot: None,
        runs: vec![],
        ledger: vec![],
        notes: vec![],
        figures: vec![],
        ..study()
    };
    let page = report(&empty);
    assert!(page.contains("No claim of this study"));
    assert!(!page.contains("<table") && !page.contains("class=\"badge"));
}

#[test]
fn a_study_survives_storage_but_for_its_pictures() {
    let study = study();
    let text = serde_json::to_string(&study).expect("plain data");
    let back: Study = serde_json::from_str(&text).expect("our own output");
    assert_eq!(back.runs, study.runs);
    assert_eq!(back.ranking, study.ranking);
    assert_eq!(back.upshot, study.upshot);
    assert_eq!(back.rows.len(), study.rows.len());
    assert!(back.figures.is_empty());
}
