//! What a benchmark is to the program: a problem, its references and its claims.

use crate::checks::Checks;
use crate::field::Field;
use crate::posed::Posed;
use crate::spec::BoundarySpec;
use crate::sweep::named::NamedSweep;
use anechoic_reference::claim::{Claim, Evidence};
use anechoic_reports::study::Finding;
use anechoic_solver::record::Record;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;
use toml::Table;

/// A benchmark with the values it is run with, sides included.
pub trait Scene: Debug + Send + Sync {
    /// What the solver is given.
    fn posed(&self) -> Posed;

    /// The sides as run.
    fn boundary(&self) -> &BoundarySpec;

    /// What must hold between fields; ranges of single fields are checked before.
    fn check(&self, checks: &mut Checks<'_>);

    /// Amplitude over which residuals are taken, in the quantity of the references; `None` where
    /// the source is no such motion, and residuals have no meaning.
    fn pulse_amplitude(&self) -> Option<f64> {
        None
    }

    /// When echoes are looked for; never, where the scene has norms of its own.
    fn windows(&self) -> Vec<Window> {
        Vec::new()
    }

    /// What is true at the receivers, at the given times (s).
    ///
    /// # Errors
    /// The reason why there is no reference for this scene as it stands.
    fn references(&self, _times: &[f64]) -> Result<Vec<Reference>, String> {
        Ok(Vec::new())
    }

    /// The same by a finer quadrature, where they have one: what that changes is their own error.
    ///
    /// # Errors
    /// As [`Scene::references`].
    fn finer_references(&self, _times: &[f64]) -> Result<Option<Vec<Reference>>, String> {
        Ok(None)
    }

    /// The scene with sides so far away that nothing comes back, where what is true has to be solved
    /// for; see [`crate::certified`].
    fn extended(&self) -> Option<Posed> {
        None
    }

    /// Do its own norms need the extended run of the same mesh, wherever a method is run?
    fn needs_extended(&self) -> bool {
        false
    }

    /// What is measured of a run by the scene's own norms, beside others of the same study.
    fn measures(&self, _run: &Record, _beside: &Beside<'_>) -> Vec<OwnNumber> {
        Vec::new()
    }

    /// Pictures of the scene's own numbers.
    fn pictures(&self) -> Vec<OwnPicture> {
        Vec::new()
    }

    /// The curve of a run in the picture called `name`.
    fn curve(&self, _name: &str, _run: &Record) -> Option<Curve> {
        None
    }

    /// Which of the paper's tests this is, as [`anechoic_reference::paper`] names it.
    fn paper_test(&self) -> Option<&'static str> {
        None
    }

    /// What is claimed of the methods.
    fn claims(&self) -> Vec<SceneClaim>;

    /// Edge (m) of the cells in use, by which errors are said to fall.
    fn cell_m(&self) -> f64;

    /// What is claimed of the orders with which errors fall when cells of these `sizes` (m), coarse
    /// to fine, are run; asked of the finest. A claim's place is that of
    /// [`anechoic_reports::convergence::Curve::order_place`].
    fn orders(&self, _sizes: &[f64]) -> Vec<SceneClaim> {
        Vec::new()
    }

    /// What is claimed of the cost of an echo, as [`anechoic_reports::tradeoff::RELATIVE_COST`].
    fn trades(&self) -> Vec<Claim> {
        Vec::new()
    }

    /// Until when (s) no wave can have come back from the outer end of an extended domain, so that
    /// the record of this scene certifies others; `None` when it has no such domain.
    fn serves_until_s(&self) -> Option<f64> {
        None
    }
}

/// Abscissae and ordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Abscissae, increasing.
    pub x: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
}

/// A picture of one of the scene's own numbers, all methods in it.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnPicture {
    /// File name without extension.
    pub name: &'static str,
    /// Title.
    pub title: &'static str,
    /// What it shows and how to read it.
    pub caption: &'static str,
    /// Name and unit of the abscissae.
    pub x: (&'static str, &'static str),
    /// Name and unit of the ordinates.
    pub y: (&'static str, &'static str),
    /// What is true, with its name.
    pub truth: Option<(&'static str, Curve)>,
    /// Places on the way with what happens there.
    pub marks: Vec<(f64, String)>,
}

/// Runs of the same study that a run is set beside.
#[derive(Clone, Copy, Debug, Default)]
pub struct Beside<'a> {
    /// The run of the scene's standard method, which absorbs nothing.
    pub standard: Option<&'a Record>,
    /// The run of the extended domain with the other sides alike, while it serves to the end of the run.
    pub extended: Option<&'a Record>,
    /// The same of the standard run.
    pub standard_extended: Option<&'a Record>,
}

/// A number by a scene's own norm.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnNumber {
    /// Metric id.
    pub metric: &'static str,
    /// Receiver, body, or where on its way.
    pub place: String,
    /// The number, or the reason that there is none.
    pub value: Result<f64, String>,
    /// Unit; ratios have `1`.
    pub unit: &'static str,
    /// Kind and name of what it was measured against.
    pub against: Option<(Evidence, &'static str)>,
}

/// The time in which a receiver's echo is looked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Window {
    /// The receiver.
    pub receiver: String,
    /// Empty for the scene's own window; otherwise it is told apart as `RECEIVER:LABEL`.
    pub label: String,
    /// Start (s), itself excluded.
    pub from_s: f64,
    /// End (s), included; `None`: the end of the run.
    pub to_s: Option<f64>,
    /// Evidence and its name, where a paper says what is accepted in this window; `None`: that of
    /// the reference.
    pub stated_by: Option<(Evidence, &'static str)>,
}

impl Window {
    /// The window's name in rows.
    pub fn place(&self) -> String {
        if self.label.is_empty() {
            self.receiver.clone()
        } else {
            format!("{}:{}", self.receiver, self.label)
        }
    }
}

/// What a reference is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// What the boundaries as modelled would give exactly: it judges the solver.
    Modelled,
    /// What a boundary without echo would give: it judges the method.
    NoEcho,
}

/// Which motion of a receiver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Displacement (m).
    Displacement,
    /// Velocity (m/s).
    Velocity,
}

impl Quantity {
    /// Letter in column names.
    pub fn letter(self) -> char {
        match self {
            Quantity::Displacement => 'u',
            Quantity::Velocity => 'v',
        }
    }
}

/// True series at the receivers.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Name in rows.
    pub name: &'static str,
    /// What it judges.
    pub role: Role,
    /// Kind of evidence.
    pub evidence: Evidence,
    /// Displacement or velocity.
    pub quantity: Quantity,
    /// One entry a receiver: name, and a component for each axis at the asked times.
    pub receivers: Vec<(String, Vec<Vec<f64>>)>,
    /// Separate pulses with silence between them, so that arrivals can be timed.
    pub pulses: bool,
}

/// A claim, and why it does not apply to the scene as run, if so.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneClaim {
    /// The claim.
    pub claim: Claim,
    /// Reason why it is not evaluated.
    pub not_here: Option<String>,
}

/// A named TOML snippet laid over the scene's values.
#[derive(Debug)]
pub struct Overlay {
    /// Name in flags.
    pub name: &'static str,
    /// What it changes, in a line.
    pub summary: &'static str,
    /// The values.
    pub toml: &'static str,
    /// Only when it is asked for by name.
    pub on_request: bool,
}

impl Overlay {
    /// An overlay.
    pub const fn new(name: &'static str, summary: &'static str, toml: &'static str) -> Self {
        Overlay {
            name,
            summary,
            toml,
            on_request: false,
        }
    }

    /// The same, only when it is asked for by name: a comparison of all methods leaves it out.
    pub const fn on_request(mut self) -> Self {
        self.on_request = true;
        self
    }
}

/// A benchmark as the registry knows it.
#[derive(Debug)]
pub struct SceneInfo {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in a line.
    pub title: &'static str,
    /// What happens in it, in a few sentences.
    pub summary: &'static str,
    /// Paper, section.
    pub source: &'static str,
    /// Its fields, in the order in which they are shown.
    pub fields: &'static [&'static [Field]],
    /// Discretisation, point mode and duration.
    pub profiles: &'static [Overlay],
    /// Other readings of the paper, other loads.
    pub presets: &'static [Overlay],
    /// Boundary methods that apply, as presets over sides.
    pub methods: &'static [Overlay],
    /// Methods taken apart: variants of a method, named `METHOD/VARIANT`, that `ablation` compares.
    pub ablation: &'static [Overlay],
    /// Sweeps that belong to it.
    pub sweeps: &'static [&'static NamedSweep],
    /// What the paper says and how it fares: finding, place, note.
    pub ledger: &'static [(Finding, &'static str, &'static str)],
    /// The method that absorbs nothing, over which echoes are taken.
    pub standard: &'static str,
    /// The scene's own values.
    pub defaults: fn() -> Table,
    /// The scene with checked values.
    pub build: fn(Table) -> Result<Box<dyn Scene>, toml::de::Error>,
}

impl SceneInfo {
    /// The method or variant called `name`.
    pub fn method(&self, name: &str) -> Option<&'static Overlay> {
        let variants = self.methods.iter().chain(self.ablation);
        variants.into_iter().find(|overlay| overlay.name == name)
    }

    /// All fields in one list.
    pub fn all_fields(&self) -> Vec<&'static Field> {
        self.fields.iter().flat_map(|group| group.iter()).collect()
    }
}

/// A scene's own values as a table.
pub fn defaults<S: Default + Serialize>() -> Table {
    Table::try_from(S::default()).expect("scenes are tables of plain values")
}

/// A scene out of a table.
///
/// # Errors
/// What the table lacks; cannot happen for tables whose fields were checked.
pub fn build<S: Scene + DeserializeOwned + 'static>(
    table: Table,
) -> Result<Box<dyn Scene>, toml::de::Error> {
    Ok(Box::new(table.try_into::<S>()?))
}
