//! A study as jobs of an existing engine: files for Snakemake and for Slurm, one shard a job, with
//! time and memory from the bill of its runs.

use super::references::wanted;
use super::{Options, Plan};
use crate::certified::causality::buffered;
use crate::certified::library::Library;
use crate::error::CaseError;
use crate::prepare::Prepared;
use crate::shard::Shard;
use crate::store::write_file;
use crate::timing;
use anechoic_solver::Bill;
use std::path::{Path, PathBuf};

/// What a shard should take (s) where nobody says how many there are.
const USUAL_S: f64 = 600.0;

/// A job may take this much longer than estimated, since nodes differ and share their memory.
const SLACK: f64 = 3.0;

/// What a job may take on top (s): start, disk, pictures.
const START_S: f64 = 600.0;

/// Memory of the program without runs (bytes), pictures included.
const BASE_BYTES: f64 = 512e6;

/// Memory of a direct solver's factor over that of all else, at most in two dimensions.
const FACTOR: f64 = 1.0;

/// The files, by their names: plain text with `@NAME@` where the plan's own goes.
const FILES: [(&str, &str); 4] = [
    ("Snakefile", include_str!("workflow/Snakefile.in")),
    ("slurm.sh", include_str!("workflow/slurm.sh.in")),
    ("slurm-merge.sh", include_str!("workflow/slurm-merge.sh.in")),
    (
        "profile/config.yaml",
        include_str!("workflow/config.yaml.in"),
    ),
];

/// Memory of a run at its peak (bytes).
fn peak_bytes(bill: &Bill) -> f64 {
    (1.0 + FACTOR) * bill.bytes() as f64
}

/// Memory of a run's record (bytes).
fn record_bytes(scene: &Prepared) -> f64 {
    let items = scene.bill.items.iter();
    items.map(|item| item.record_bytes as f64).sum()
}

/// A study in shards, written down.
#[derive(Debug)]
pub struct Workflow {
    /// Folder of the files.
    pub folder: PathBuf,
    /// The files.
    pub files: Vec<PathBuf>,
    /// Shards.
    pub shards: usize,
    /// Distinct runs.
    pub runs: usize,
    /// References that are missing and solved for.
    pub references: usize,
    /// About what all shards take together (s).
    pub total_s: f64,
    /// About what the longest shard takes (s).
    pub longest_s: f64,
}

/// What a job asks of a scheduler.
struct Need {
    minutes: u64,
    megabytes: u64,
}

impl Need {
    fn of(work_s: f64, bytes: f64) -> Self {
        Need {
            minutes: ((SLACK * work_s + START_S) / 60.0).ceil() as u64,
            megabytes: ((BASE_BYTES + bytes) / 1e6).ceil() as u64,
        }
    }
}

/// Writes the files of a plan in `shards` jobs, or as many as take some minutes each, into a folder.
/// `program` is what the jobs call, `command` its words.
///
/// # Errors
/// [`CaseError::Usage`] for a folder or words that scripts cannot name, and for more shards than
/// runs; [`CaseError::Storage`].
pub fn workflow(
    mut plan: Plan,
    options: &Options,
    shards: Option<usize>,
    folder: &Path,
    (program, command): (&Path, &[String]),
) -> Result<Workflow, CaseError> {
    let dir = plain(folder)?;
    plan.keep_distinct();
    let costs = Costs::of(&plan, options)?;
    let total_s: f64 = costs.runs.iter().chain(&costs.references).sum();
    let most = plan.scenes.len();
    let usual = (total_s / options.jobs as f64 / USUAL_S).ceil() as usize;
    let shards = shards.unwrap_or(usual.clamp(1, most));
    if shards > most {
        return Err(CaseError::Usage(format!(
            "--shards {shards}: {most} runs make no more than {most} shards"
        )));
    }
    let longest_s = costs.longest(shards, options.jobs);
    let records = |scenes: &[Prepared]| scenes.iter().map(record_bytes).sum::<f64>();
    let shard_records = records(&plan.scenes) / shards as f64;
    let shard = Need::of(longest_s, options.jobs as f64 * costs.peak + shard_records);
    let merge = Need::of(
        costs.merge(options.repeats),
        costs.peak + records(&plan.scenes),
    );
    let program = quoted(&[program.display().to_string()])?;
    let command = quoted(command)?;
    let values = [
        ("SHARDS", shards.to_string()),
        ("THREADS", options.jobs.to_string()),
        ("MB", shard.megabytes.to_string()),
        ("MINUTES", shard.minutes.to_string()),
        ("MERGE_MB", merge.megabytes.to_string()),
        ("MERGE_MINUTES", merge.minutes.to_string()),
        ("DIR", dir),
        ("TITLE", command.clone()),
    ];
    let mut files = Vec::new();
    for (name, template) in FILES {
        let mut text = template.to_owned();
        for (key, value) in &values {
            text = text.replace(&format!("@{key}@"), value);
        }
        let own = |word: &str| match name {
            "Snakefile" => python(word),
            _ => word.to_owned(),
        };
        text = text.replace("@PROGRAM@", &own(&program));
        text = text.replace("@COMMAND@", &own(&command));
        let path = folder.join(name);
        write_file(&path, text.as_bytes())?;
        files.push(path);
    }
    // Slurm does not make the folder of its logs.
    let log = folder.join("log");
    std::fs::create_dir_all(&log).map_err(|source| CaseError::Storage { path: log, source })?;
    Ok(Workflow {
        folder: folder.to_owned(),
        files,
        shards,
        runs: most,
        references: costs.references.iter().filter(|s| **s > 0.0).count(),
        total_s,
        longest_s,
    })
}

/// What the runs of a plan take, by place in it.
struct Costs {
    /// CPU time of each run (s).
    runs: Vec<f64>,
    /// CPU time of each reference (s), nothing for those that are there.
    references: Vec<f64>,
    /// Memory of the largest run or reference (bytes).
    peak: f64,
}

impl Costs {
    fn of(plan: &Plan, options: &Options) -> Result<Self, CaseError> {
        let mut costs = Costs {
            runs: Vec::new(),
            references: Vec::new(),
            peak: 0.0,
        };
        for scene in &plan.scenes {
            costs.runs.push(scene.bill.seconds());
            costs.peak = costs.peak.max(peak_bytes(&scene.bill));
        }
        if !plan.kind.has_echoes() {
            return Ok(costs);
        }
        let library = Library::of_results(&options.out);
        for one in wanted(&plan.scenes) {
            let mut own = 0.0;
            if one.is_missing(&library)? {
                let bill = buffered(&one.problem, 1.0).bill()?;
                own = bill.seconds();
                costs.peak = costs.peak.max(peak_bytes(&bill));
            }
            costs.references.push(own);
        }
        Ok(costs)
    }

    /// What the longest of the shards takes with `jobs` runs at a time (s).
    fn longest(&self, shards: usize, jobs: usize) -> f64 {
        let phase = |all: &[f64], shard: &Shard| {
            let own = shard.of(all.iter().copied());
            let longest = own.iter().copied().fold(0.0, f64::max);
            longest.max(own.iter().sum::<f64>() / jobs as f64)
        };
        Shard::all(shards)
            .map(|shard| phase(&self.references, &shard) + phase(&self.runs, &shard))
            .fold(0.0, f64::max)
    }

    /// What the merge takes where nothing is missing (s): timing, and a second for each run.
    fn merge(&self, repeats: usize) -> f64 {
        let timed = |run: &f64| match repeats {
            0 => 1.0,
            _ => 1.0 + timing::seconds(*run, repeats),
        };
        self.runs.iter().map(timed).sum()
    }
}

/// The folder as text, if scripts of all kinds can name it.
fn plain(folder: &Path) -> Result<String, CaseError> {
    let text = folder.to_str().unwrap_or_default();
    let is_plain = |c: char| c.is_alphanumeric() || "./_-+=,@".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        Ok(text.trim_end_matches('/').to_owned())
    } else {
        Err(CaseError::Usage(format!(
            "--into {}: scripts name this folder; letters, digits and . / _ - + = , @ are allowed",
            folder.display()
        )))
    }
}

/// Words as a shell reads them.
fn quoted(words: &[String]) -> Result<String, CaseError> {
    if let Some(word) = words.iter().find(|word| word.contains(char::is_control)) {
        return Err(CaseError::Usage(format!(
            "{word:?}: a word of a script cannot hold control characters"
        )));
    }
    shlex::try_join(words.iter().map(String::as_str))
        .map_err(|error| CaseError::Usage(format!("{words:?}: {error}")))
}

/// Text as a Python string, whose literals hold those of JSON.
fn python(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_shard_holds_the_longest_run_whatever_the_jobs() {
        let costs = Costs {
            runs: vec![100.0, 1.0, 1.0, 1.0],
            references: vec![7.0, 0.0],
            peak: 0.0,
        };
        assert_eq!(costs.longest(1, 1), 110.0);
        assert_eq!(costs.longest(1, 4), 107.0);
        assert_eq!(costs.longest(2, 1), 108.0);
        assert_eq!(costs.longest(4, 1), 107.0);
    }

    #[test]
    fn words_that_scripts_cannot_hold_are_refused() {
        let join =
            |words: &[&str]| quoted(&words.iter().map(|w| (*w).to_owned()).collect::<Vec<_>>());
        assert_eq!(
            join(&["sweep", "a b", "it's"]).unwrap(),
            "sweep 'a b' \"it's\""
        );
        assert!(join(&["a\nb"]).is_err());
        assert_eq!(python("a\"b'"), r#""a\"b'""#);
        for folder in ["", "a b", "a{i}", "$HOME", "%a", "a\"b"] {
            assert!(plain(Path::new(folder)).is_err(), "{folder}");
        }
        assert_eq!(plain(Path::new("runs/plan-1/")).unwrap(), "runs/plan-1");
    }
}
