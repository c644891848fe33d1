//! Norms of the error of a field over points or a fixed sampling grid.

use super::{NormError, check_finite, check_length};

/// Volume-weighted norms of a difference, in the unit of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FieldNorms {
    /// Mean absolute difference: sum V abs(d) / sum V.
    pub l1: f64,
    /// Root of the mean squared difference: sqrt(sum V d^2 / sum V).
    pub l2: f64,
    /// Largest absolute difference.
    pub linf: f64,
}

/// Norms of `values - reference`, weighted by `volumes` (m3, or m2 in plane strain).
pub fn field_norms(
    values: &[f64],
    reference: &[f64],
    volumes: &[f64],
) -> Result<FieldNorms, NormError> {
    check_length("the reference field", values.len(), reference.len())?;
    check_length("the volumes", values.len(), volumes.len())?;
    check_finite("the field", values)?;
    check_finite("the reference field", reference)?;
    check_finite("the volumes", volumes)?;
    if let Some(volume) = volumes.iter().find(|v| **v <= 0.0) {
        return Err(NormError::NotPositive {
            what: "a volume".to_owned(),
            value: *volume,
        });
    }
    if values.is_empty() {
        return Err(NormError::TooFew {
            what: "a norm of a field",
            needed: 1,
            found: 0,
        });
    }
    let (mut total, mut first, mut second, mut linf) = (0.0, 0.0, 0.0, 0.0);
    for ((value, truth), volume) in values.iter().zip(reference).zip(volumes) {
        let d = (value - truth).abs();
        total += volume;
        first += volume * d;
        second += volume * d * d;
        linf = f64::max(linf, d);
    }
    Ok(FieldNorms {
        l1: first / total,
        l2: (second / total).sqrt(),
        linf,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_weight_the_differences() {
        let n = field_norms(&[1.0, 5.0], &[0.0, 3.0], &[3.0, 1.0]).expect("defined");
        assert_eq!(n.l1, 1.25);
        assert_eq!(n.l2, 1.75f64.sqrt());
        assert_eq!(n.linf, 2.0);
    }

    #[test]
    fn damaged_fields_are_refused() {
        assert!(field_norms(&[1.0], &[1.0, 2.0], &[1.0]).is_err());
        assert!(field_norms(&[f64::NAN], &[1.0], &[1.0]).is_err());
        assert!(field_norms(&[1.0], &[1.0], &[0.0]).is_err());
        assert!(field_norms(&[], &[], &[]).is_err());
    }
}
