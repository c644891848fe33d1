//! What bounds the shear stress of a material, as a caller puts it: the choice between the laws.

use super::herschel_bulkley::RateStrength;
use crate::error::SolverError;

/// Strength that goes with the elastic constants of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strength {
    /// Unbounded: elastic throughout.
    Elastic,
    /// Constant: [`super::von_mises`].
    VonMises {
        /// Undrained shear strength (Pa).
        s_u: f64,
    },
    /// Growing with the rate of shear: [`super::herschel_bulkley`].
    HerschelBulkley(RateStrength),
}

impl Strength {
    /// Checks the ranges.
    ///
    /// # Errors
    /// [`SolverError::Setup`] with the field and what it allows.
    pub fn check(&self) -> Result<(), SolverError> {
        match *self {
            Strength::Elastic => Ok(()),
            Strength::VonMises { s_u } => positive("material.s_u_Pa", s_u),
            Strength::HerschelBulkley(RateStrength {
                s_u0,
                viscosity,
                index,
                reference_rate,
            }) => {
                positive("material.s_u0_Pa", s_u0)?;
                positive("material.reference_rate_1_s", reference_rate)?;
                within("material.viscosity", viscosity, 0.0..=f64::MAX)?;
                within("material.index", index, f64::MIN_POSITIVE..=1.0)
            }
        }
    }
}

fn positive(field: &str, value: f64) -> Result<(), SolverError> {
    within(field, value, f64::MIN_POSITIVE..=f64::MAX)
}

fn within(
    field: &str,
    value: f64,
    allowed: std::ops::RangeInclusive<f64>,
) -> Result<(), SolverError> {
    if allowed.contains(&value) {
        return Ok(());
    }
    let above = if *allowed.start() > 0.0 {
        "above 0"
    } else {
        "from 0"
    };
    let upto = if *allowed.end() < f64::MAX {
        format!(" up to {}", allowed.end())
    } else {
        String::new()
    };
    Err(SolverError::Setup {
        field: field.to_owned(),
        reason: format!("{value} is out of range: use a finite number {above}{upto}"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const SLIDE: RateStrength = RateStrength {
        s_u0: 500.0,
        viscosity: 0.65,
        index: 0.4,
        reference_rate: 0.06,
    };

    #[test]
    fn what_the_scenes_use_passes() {
        assert_eq!(Strength::Elastic.check(), Ok(()));
        assert_eq!(Strength::VonMises { s_u: 2500.0 }.check(), Ok(()));
        assert_eq!(Strength::HerschelBulkley(SLIDE).check(), Ok(()));
    }

    #[test]
    fn every_field_out_of_range_is_named() {
        let rate = |change: fn(&mut RateStrength)| {
            let mut slide = SLIDE;
            change(&mut slide);
            Strength::HerschelBulkley(slide)
        };
        for (strength, wanted) in [
            (Strength::VonMises { s_u: 0.0 }, "material.s_u_Pa"),
            (Strength::VonMises { s_u: f64::NAN }, "material.s_u_Pa"),
            (rate(|s| s.s_u0 = -1.0), "material.s_u0_Pa"),
            (rate(|s| s.viscosity = -0.1), "material.viscosity"),
            (rate(|s| s.viscosity = f64::INFINITY), "material.viscosity"),
            (rate(|s| s.index = 0.0), "material.index"),
            (rate(|s| s.index = 1.5), "material.index"),
            (
                rate(|s| s.reference_rate = 0.0),
                "material.reference_rate_1_s",
            ),
        ] {
            match strength.check() {
                Err(SolverError::Setup { field, .. }) => assert_eq!(field, wanted),
                other => panic!("{strength:?}: {other:?}"),
            }
        }
    }
}
