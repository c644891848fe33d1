//! From what was asked (case or file, profile, presets, method, `--set`) to a scene ready to run.

use crate::checks::Checks;
use crate::draft::{Draft, HEADER, Origins, Source, line_column, parse};
use crate::error::{CaseError, Complaint, Origin};
use crate::scene::{Overlay, Scene, SceneInfo};
use crate::scenes;
use crate::spec::BoundarySpec;
use anechoic_solver::Bill;
use anechoic_solver::error::SolverError;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// The profile of a command that names none.
pub const DEFAULT_PROFILE: &str = "quick";

/// What was asked of a command.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// Name of a case, or a TOML file that names one.
    pub target: String,
    /// Profile; over the file's.
    pub profile: Option<String>,
    /// Presets, laid in this order; over the file's list.
    pub presets: Vec<String>,
    /// Assignments `field=value`.
    pub sets: Vec<String>,
}

/// A scene ready to run.
#[derive(Debug)]
pub struct Prepared {
    /// The benchmark.
    pub info: &'static SceneInfo,
    /// Profile's name.
    pub profile: String,
    /// Method as in rows.
    pub method: String,
    /// The scene.
    pub scene: Box<dyn Scene>,
    /// Its values, which it can be built from again.
    pub table: Table,
    /// Where they come from.
    pub origins: Origins,
    /// What it will cost.
    pub bill: Bill,
    /// `--set METHOD.field=value` that reached no side.
    pub unused: Vec<String>,
}

/// A case with the text of its file, read once.
#[derive(Clone, Debug)]
pub struct Target {
    /// The benchmark.
    pub info: &'static SceneInfo,
    /// Profile's name.
    pub profile: &'static Overlay,
    presets: Vec<&'static Overlay>,
    file: Option<(PathBuf, String)>,
    sets: Vec<String>,
}

impl Target {
    /// Finds case, file, profile and presets.
    ///
    /// # Errors
    /// [`CaseError::Unknown`], [`CaseError::Read`], [`CaseError::Syntax`], [`CaseError::NoCase`].
    pub fn find(request: &Request) -> Result<Self, CaseError> {
        let path = Path::new(&request.target);
        // results of a case lie in folders named like it
        let known = scenes::find(&request.target).is_ok();
        let is_file = path.extension().is_some_and(|e| e == "toml")
            || path.is_file()
            || path.is_dir() && !known;
        let (info, header, file) = if is_file {
            let text = std::fs::read_to_string(path).map_err(|source| CaseError::Read {
                path: path.to_owned(),
                source,
            })?;
            let header = Header::read(path, &text)?;
            let info = scenes::find(&header.case).map_err(|error| header.blame("case", error))?;
            (info, header, Some((path.to_owned(), text)))
        } else {
            (scenes::find(&request.target)?, Header::default(), None)
        };
        let profile = match (&request.profile, &header.profile) {
            (Some(name), _) => pick("profile", name, info.profiles)?,
            (None, Some(name)) => pick("profile", name, info.profiles)
                .map_err(|error| header.blame("profile", error))?,
            (None, None) => pick("profile", DEFAULT_PROFILE, info.profiles)?,
        };
        let presets = |names: &[String]| {
            let picked = names.iter().map(|name| pick("preset", name, info.presets));
            picked.collect::<Result<Vec<_>, _>>()
        };
        let presets = if request.presets.is_empty() {
            presets(&header.presets).map_err(|error| header.blame("preset", error))?
        } else {
            presets(&request.presets)?
        };
        Ok(Target {
            info,
            profile,
            presets,
            file,
            sets: request.sets.clone(),
        })
    }

    /// The scene with the sides as they stand, or with those of a method.
    ///
    /// # Errors
    /// [`CaseError::Scene`] with everything that is wrong, [`CaseError::Unknown`] method.
    pub fn prepare(&self, method: Option<&str>) -> Result<Prepared, CaseError> {
        let finished = self.draft(method)?.finish()?;
        let scene = (self.info.build)(finished.table.clone()).map_err(|error| {
            CaseError::Scene(vec![Complaint {
                origin: Origin::Default,
                field: self.info.name.to_owned(),
                message: error.message().to_owned(),
            }])
        })?;
        let mut checks = Checks::new(&finished.origins);
        scene.check(&mut checks);
        let complaints = checks.into_complaints();
        if !complaints.is_empty() {
            return Err(CaseError::Scene(complaints));
        }
        let bill = scene.posed().bill().map_err(|error| match error {
            SolverError::Setup { field, reason } => CaseError::Scene(vec![Complaint {
                origin: finished.origins.of(&field),
                field,
                message: reason,
            }]),
            other => CaseError::Solver(other),
        })?;
        Ok(Prepared {
            info: self.info,
            profile: self.profile.name.to_owned(),
            method: match method {
                Some(name) => name.to_owned(),
                None => self.row_name(scene.boundary()),
            },
            scene,
            table: finished.table,
            origins: finished.origins,
            bill,
            unused: finished.unused,
        })
    }

    /// Does the file say anything of the sides?
    pub fn names_sides(&self) -> bool {
        self.file.as_ref().is_some_and(|(_, text)| {
            text.parse::<Table>()
                .is_ok_and(|table| table.contains_key("boundary"))
        })
    }

    fn draft(&self, method: Option<&str>) -> Result<Draft, CaseError> {
        let mut draft = Draft::new((self.info.defaults)(), self.info.all_fields());
        draft.overlay(self.profile.toml, &built_in("profile", self.profile))?;
        for preset in &self.presets {
            draft.overlay(preset.toml, &built_in("preset", preset))?;
        }
        if let Some((path, text)) = &self.file {
            draft.overlay(text, &Source::File(path.clone()))?;
        }
        if let Some(name) = method {
            let method = self.info.method(name).ok_or_else(|| {
                let known = self.info.methods.iter().chain(self.info.ablation);
                CaseError::unknown("method", name, known.map(|o| o.name))
            })?;
            draft.overlay(method.toml, &built_in("method", method))?;
        }
        for assignment in &self.sets {
            draft.set(assignment)?;
        }
        Ok(draft)
    }

    /// The method whose preset puts the same methods with the same parameters on the sides; else the
    /// only one that puts the same methods there; else the sides' methods.
    fn row_name(&self, sides: &BoundarySpec) -> String {
        let names = |sides: &BoundarySpec| -> Vec<String> {
            let named = sides.named().into_iter();
            named.map(|(_, side)| side.method.clone()).collect()
        };
        let wanted = names(sides);
        let presets = self.info.methods.iter().filter_map(|method| {
            let mut draft = Draft::new((self.info.defaults)(), self.info.all_fields());
            draft
                .overlay(method.toml, &built_in("method", method))
                .ok()?;
            let scene = (self.info.build)(draft.finish().ok()?.table).ok()?;
            Some((method.name, scene.boundary().clone()))
        });
        let presets: Vec<(&str, BoundarySpec)> = presets.collect();
        if let Some((name, _)) = presets.iter().find(|(_, preset)| preset == sides) {
            return (*name).to_owned();
        }
        let mut alike = presets.iter().filter(|(_, preset)| names(preset) == wanted);
        if let (Some((name, _)), None) = (alike.next(), alike.next()) {
            return (*name).to_owned();
        }
        // What all presets have in common belongs to the scene: the rest tells, rollers and free sides too.
        let of_scene = |side: usize, method: &String| {
            let mut presets = presets.iter().map(|(_, preset)| names(preset));
            presets.all(|preset| preset[side] == *method)
        };
        let mut telling: Vec<&str> = Vec::new();
        for (side, method) in wanted.iter().enumerate() {
            if !of_scene(side, method) && !telling.contains(&method.as_str()) {
                telling.push(method);
            }
        }
        telling.join("+")
    }
}

impl Prepared {
    /// The values as canonical text: keys sorted, case named.
    pub fn canonical(&self) -> String {
        let mut table = self.table.clone();
        table.insert("case".into(), Value::String(self.info.name.into()));
        table.to_string()
    }

    /// First 16 hexadecimal digits of the SHA-256 of the canonical text.
    pub fn hash(&self) -> String {
        let digest = Sha256::digest(self.canonical().as_bytes());
        digest[..8]
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect()
    }
}

/// What a file says beside the scene's fields.
#[derive(Debug, Default)]
struct Header {
    case: String,
    profile: Option<String>,
    presets: Vec<String>,
    /// Where each of them stands.
    origins: BTreeMap<&'static str, Origin>,
}

impl Header {
    /// The error with the line of the field that it is about.
    fn blame(&self, field: &str, error: CaseError) -> CaseError {
        CaseError::InFile {
            origin: self.origins.get(field).cloned().unwrap_or(Origin::Default),
            error: Box::new(error),
        }
    }

    fn read(path: &Path, text: &str) -> Result<Self, CaseError> {
        let document = parse(text, &Source::File(path.to_owned()))?;
        let origin = |field: &str| {
            let at = document.as_table().key(field).and_then(|key| key.span());
            Origin::File {
                path: path.to_owned(),
                line: line_column(text, at.map_or(0, |span| span.start)).0,
            }
        };
        let wrong = |field: &str, expected: &str| {
            CaseError::Scene(vec![Complaint {
                origin: origin(field),
                field: field.to_owned(),
                message: format!("expected {expected}"),
            }])
        };
        let word = |field: &'static str| match document.get(field) {
            None => Ok(None),
            Some(item) => item
                .as_str()
                .map(|name| Some(name.to_owned()))
                .ok_or_else(|| wrong(field, "a name")),
        };
        let presets = match document.get("preset") {
            None => Vec::new(),
            Some(item) => item
                .as_array()
                .and_then(|list| list.iter().map(|v| v.as_str().map(str::to_owned)).collect())
                .ok_or_else(|| wrong("preset", "a list of names"))?,
        };
        Ok(Header {
            case: word("case")?.ok_or_else(|| CaseError::NoCase(path.to_owned()))?,
            profile: word("profile")?,
            presets,
            origins: HEADER.iter().map(|field| (*field, origin(field))).collect(),
        })
    }
}

fn built_in(kind: &str, overlay: &Overlay) -> Source {
    Source::BuiltIn(format!("{kind} {}", overlay.name))
}

fn pick(
    what: &'static str,
    name: &str,
    known: &'static [Overlay],
) -> Result<&'static Overlay, CaseError> {
    known
        .iter()
        .find(|overlay| overlay.name == name)
        .ok_or_else(|| CaseError::unknown(what, name, known.iter().map(|o| o.name)))
}
