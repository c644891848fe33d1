//! A method of a scene as the atlas takes it: one side, its numbers, and the closed form that judges it.

use super::strip::Strip;
use super::{AtlasError, Side};
use crate::checks::{inner_thickness, number};
use crate::prepare::Prepared;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::oblique::damping::Layer;
use anechoic_reference::analytic::oblique::{Medium, ObliqueError, Wave};
use anechoic_solver::boundary::{ParamKind, SideMethod, Value, find, pml};
use anechoic_solver::problem::{Drive, PointMode, Problem, Scheme, Transfer};

/// A method with what the scene puts around it.
#[derive(Clone, Debug)]
pub struct Subject {
    /// Method as in rows.
    pub name: String,
    /// The side's method, with whole cells of thickness.
    pub side: SideMethod,
    /// Edge of a cell (m).
    pub h: f64,
    /// Frequency of the waves (Hz): that of the scene's source.
    pub frequency: f64,
    like: Problem<2>,
}

impl Subject {
    /// The side of a scene that its method is on.
    ///
    /// # Errors
    /// A scene without waves.
    pub fn of(scene: &Prepared) -> Result<Self, AtlasError> {
        let Some(like) = scene.scene.posed().plane() else {
            return Err(AtlasError::Unsupported {
                field: "case",
                reason: "it is three-dimensional, and the atlas is of plane strain",
            });
        };
        if like.scheme == Scheme::QuasiStatic {
            return Err(AtlasError::Unsupported {
                field: "time.scheme",
                reason: "without inertia there are no waves; use \"newmark\"",
            });
        }
        let pulse = like.drives.first().map(|drive| match drive {
            Drive::SideVelocity { pulse, .. } | Drive::PointForce { pulse, .. } => pulse,
        });
        let Some(frequency) = pulse.map(|pulse| pulse.frequency) else {
            return Err(AtlasError::Unsupported {
                field: "source",
                reason: "the waves' frequency is that of the scene's source, and it has none",
            });
        };
        if like.aspect != 1.0 {
            return Err(AtlasError::Unsupported {
                field: "grid.aspect",
                reason: "a strip has square cells; leave it out",
            });
        }
        let [_, [bottom, _]] = &like.sides;
        let [[left, right], [_, top]] = &like.sides;
        let sides = [right, bottom, left, top];
        let told = |side: &&&SideMethod| !["free", "roller"].contains(&side.method.as_str());
        let held = |side: &&&SideMethod| side.method != "free";
        let found = sides.iter().find(told).or(sides.iter().find(held));
        let mut side = (*found.unwrap_or(&right)).clone();
        let h = scene.scene.cell_m();
        if let Some(thickness) = thickness(&side, h)
            && inner_thickness(&side) == 0.0
        {
            side = side.with("thickness_m", whole(thickness, h));
        }
        Ok(Subject {
            name: scene.method.clone(),
            side,
            h,
            frequency,
            like,
        })
    }

    /// The same with a layer of `cells` cells outside the body.
    pub fn of_cells(&self, cells: f64) -> Self {
        Subject {
            side: self.side.clone().with("thickness_m", cells * self.h),
            ..self.clone()
        }
    }

    /// The same side of the body on other cells, `factor` times as large, with steps in proportion: what
    /// follows from the number of cells stays.
    pub fn on_cells(&self, factor: f64) -> Self {
        let mut side = self.side.clone();
        if side.method == pml::METHOD.name {
            side = side.with("reflection", self.aim());
        }
        let mut like = self.like.clone();
        like.dt *= factor;
        Subject {
            h: self.h * factor,
            side,
            like,
            ..self.clone()
        }
    }

    /// Is it a layer outside the body, whose thickness can be chosen?
    pub fn is_layer(&self) -> bool {
        ["damping-layer", "pml", "pml-stretched"].contains(&self.side.method.as_str())
            && inner_thickness(&self.side) == 0.0
    }

    /// Thickness of the layer (m); 0 where there is none.
    pub fn thickness(&self) -> f64 {
        number(&self.side, "thickness_m").unwrap_or(0.0)
    }

    /// Measures the side's response.
    ///
    /// # Errors
    /// As [`Side::new`].
    pub fn measure(&self) -> Result<Side, AtlasError> {
        let strip = Strip::new(&self.like, &self.side, self.h, inner_thickness(&self.side))?;
        Side::new(&strip, self.frequency)
    }

    /// Length of a wave in the continuum (m).
    pub fn wavelength(&self, wave: Wave) -> f64 {
        let material = &self.like.material;
        let speed = match wave {
            Wave::P => material.p_speed(),
            Wave::S => material.s_speed(),
        };
        speed / self.frequency
    }

    /// All that comes back by the method's closed form; `None` for a method without one.
    pub fn closed(&self, wave: Wave, angle: f64) -> Option<Result<f64, ObliqueError>> {
        let law: fn(&Self, &Medium) -> Result<f64, ObliqueError> = match self.side.method.as_str() {
            "fixed" | "free" | "roller" | "extended" => return Some(Ok(1.0)),
            "dashpot" => |own, medium| {
                let share = own.parameter("impedance");
                Ok(medium.dashpot(share).total(medium.incident()))
            },
            "pml" => |own, medium| {
                let strength = -0.5 * own.like.material.p_speed() * own.aim().ln();
                Ok(medium.stretched(strength).total(medium.incident()))
            },
            "damping-layer" if self.ends_fixed() => |own, medium| {
                let (thickness, power) = (own.thickness(), own.parameter("power"));
                let largest = own.parameter("sigma_max_per_s");
                let rate = |x: f64| largest * (x / thickness).powf(power);
                let layer = Layer { thickness, rate };
                let reflection = layer.reflection(medium, own.frequency)?;
                Ok(reflection.total(medium.incident()))
            },
            _ => return None,
        };
        Some(
            self.medium(wave, angle)
                .and_then(|medium| law(self, &medium)),
        )
    }

    /// The scene's problem with points at rest.
    pub fn resting(&self) -> Problem<2> {
        Problem {
            cell_size: self.h,
            aspect: 1.0,
            inclusion: None,
            point_mode: PointMode::Frozen,
            transfer: Transfer::Keep,
            ..self.like.clone()
        }
    }

    /// The scene's material.
    pub fn solid(&self) -> Elastic {
        let m = &self.like.material;
        Elastic::new(m.youngs_modulus, m.poissons_ratio, m.density)
            .expect("a material that the solver took")
    }

    fn medium(&self, wave: Wave, angle: f64) -> Result<Medium, ObliqueError> {
        Medium::new(&self.solid(), wave, angle)
    }

    /// Reflection that a perfectly matched layer aims at.
    fn aim(&self) -> f64 {
        pml::reflection(&self.side, self.thickness() / self.h)
    }

    fn ends_fixed(&self) -> bool {
        let end = self.side.params.get("end");
        end.is_none_or(|end| *end == Value::Text("fixed".to_owned()))
    }

    /// A number of the method, given or its default.
    fn parameter(&self, key: &str) -> f64 {
        let default = || match find(&self.side.method)?.param(key)?.kind {
            ParamKind::Number { default, .. } => default,
            ParamKind::Choice(_) => None,
        };
        number(&self.side, key)
            .or_else(default)
            .expect("a number of the method with a default")
    }
}

/// Thickness of a layer (m), given or the default of its method; `None` for what is no layer.
fn thickness(side: &SideMethod, h: f64) -> Option<f64> {
    let default = match side.method.as_str() {
        "pml" => Some(pml::DEFAULT_CELLS * h),
        "pml-stretched" => Some(anechoic_solver::boundary::pml_stretched::DEFAULT_CELLS * h),
        _ => None,
    };
    number(side, "thickness_m").or(default)
}

/// Whole cells of `h` that cover a length.
fn whole(length: f64, h: f64) -> f64 {
    h * (length / h - 1e-6).ceil()
}
