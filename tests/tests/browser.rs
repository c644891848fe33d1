//! Reports in a real browser, as people see them: pictures and tables are there, and no page is wider
//! than its window, be it a desk's or a phone's. Evaluated where Chromium is installed.

use anechoic::commands::{compare, converge};
use anechoic::over::Over;
use anechoic_tests::study::narrow_column;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Widths (px) of a desk's window and of a phone.
const WIDTHS: [u64; 2] = [1280, 390];

/// What the page says of itself, put into the document around it.
const PROBE: &str = r#"<script>addEventListener("load", () => {
  const all = (what) => [...document.querySelectorAll(what)];
  const found = {
    width: innerWidth,
    page: document.documentElement.scrollWidth,
    images: [...document.images].map((image) => image.naturalWidth),
    drawings: all("figure svg").map((svg) => Math.round(svg.getBoundingClientRect().width)),
    tables: all("table").map((table) => table.rows.length),
    commands: all("figure .command code").map((code) => code.textContent),
  };
  const out = parent.document.createElement("pre");
  out.id = "probe";
  out.textContent = JSON.stringify(found);
  parent.document.body.append(out);
});</script></body>"#;

/// Chromium on the path, under the names that systems give it.
fn browser() -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    let mut all =
        std::env::split_paths(&path).flat_map(|folder| names.map(|name| folder.join(name)));
    all.find(|program| program.is_file())
}

/// What a report says of itself in a frame of a width; a window of its own may not be as narrow.
fn seen(browser: &Path, report: &Path, width: u64) -> Value {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let page = std::fs::read_to_string(report).expect("a report");
    assert!(page.contains("</body>"));
    let page = page.replace("</body>", PROBE);
    let page = page.replace('&', "&amp;").replace('"', "&quot;");
    let frame = format!(
        "<!doctype html><body><iframe width=\"{width}\" height=\"900\" style=\"border:0\" srcdoc=\"{page}\"></iframe></body>"
    );
    let file = folder.path().join("frame.html");
    std::fs::write(&file, frame).expect("written");
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .arg(format!(
            "--user-data-dir={}",
            folder.path().join("profile").display()
        ))
        .arg("--window-size=1400,1000")
        .arg(format!("file://{}", file.display()))
        .output()
        .expect("a browser that starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let probe = text
        .split("<pre id=\"probe\">")
        .nth(1)
        .and_then(|rest| rest.split("</pre>").next());
    let probe = probe.unwrap_or_else(|| {
        panic!(
            "the page said nothing: {}",
            String::from_utf8_lossy(&output.stderr)
        )
    });
    serde_json::from_str(&probe.replace("&amp;", "&")).expect("what the page says")
}

/// Insists that a report shows what it should at all widths.
fn looks_right(browser: &Path, report: &Path, images: usize, drawings: usize) {
    for width in WIDTHS {
        let found = seen(browser, report, width);
        let numbers = |what: &str| -> Vec<u64> {
            let list = found[what].as_array().expect("a list");
            list.iter().filter_map(Value::as_u64).collect()
        };
        let name = report.display();
        println!("{name} at {width} px: {found}");
        assert_eq!(found["width"].as_u64(), Some(width));
        assert!(
            found["page"].as_u64() <= Some(width),
            "{name} is wider than {width} px"
        );
        assert_eq!(numbers("images").len(), images);
        assert!(numbers("images").iter().all(|natural| *natural > 0));
        assert_eq!(numbers("drawings").len(), drawings);
        assert!(numbers("drawings").iter().all(|drawn| *drawn > 300));
        assert!(numbers("tables").len() > 3);
        assert!(
            numbers("tables").iter().all(|rows| *rows > 1),
            "{name} has an empty table"
        );
        let commands = found["commands"].as_array().expect("a list");
        assert_eq!(commands.len(), images + drawings);
        assert!(
            commands
                .iter()
                .all(|command| command.as_str().is_some_and(|c| c.starts_with("anechoic ")))
        );
    }
}

#[test]
fn reports_are_whole_on_a_desk_and_on_a_phone() {
    let Some(browser) = browser() else {
        println!("not evaluated: there is no Chromium on the path");
        return;
    };
    let out = tempfile::tempdir().expect("a temporary folder");
    let options = narrow_column(out.path());
    let finished = compare(&options).unwrap_or_else(|error| panic!("{error}"));
    looks_right(&browser, &finished.study.report, 1, 4);
    let over =
        ["grid.h_m=2,1", "time.dt_s=0.01,0.005"].map(|text| Over::parse(text).expect("levels"));
    let finished = converge(&options.method("dashpot"), &over, true);
    let finished = finished.unwrap_or_else(|error| panic!("{error}"));
    looks_right(&browser, &finished.study.report, 0, 4);
}
