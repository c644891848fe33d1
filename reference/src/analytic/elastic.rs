//! Isotropic linear elasticity in plane strain: moduli and wave speeds.

use num_complex::Complex64;
use thiserror::Error;

/// Constants that describe no elastic material.
#[derive(Clone, Debug, PartialEq, Error)]
#[error(
    "elastic constant {field} = {value} {unit} is out of range: use {allowed}, since wave speeds need a stable, compressible material"
)]
pub struct ElasticError {
    /// Which constant.
    pub field: &'static str,
    /// What was given.
    pub value: f64,
    /// Unit of the value.
    pub unit: &'static str,
    /// What is allowed.
    pub allowed: &'static str,
}

/// A linear elastic isotropic solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    young: f64,
    poisson: f64,
    density: f64,
}

impl Elastic {
    /// From Young's modulus E (Pa), Poisson's ratio and density (kg/m3).
    pub fn new(young: f64, poisson: f64, density: f64) -> Result<Self, ElasticError> {
        let positive = |field, value: f64, unit| {
            if value.is_finite() && value > 0.0 {
                Ok(value)
            } else {
                let allowed = "a positive finite number";
                Err(ElasticError {
                    field,
                    value,
                    unit,
                    allowed,
                })
            }
        };
        if !(poisson > -1.0 && poisson < 0.5) {
            return Err(ElasticError {
                field: "nu",
                value: poisson,
                unit: "(no unit)",
                allowed: "-1 < nu < 0.5",
            });
        }
        Ok(Elastic {
            young: positive("E", young, "Pa")?,
            poisson,
            density: positive("rho", density, "kg/m3")?,
        })
    }

    /// Density rho (kg/m3).
    pub fn density(&self) -> f64 {
        self.density
    }

    /// Shear modulus G (Pa).
    pub fn shear_modulus(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }

    /// Lame's first constant lambda (Pa).
    pub fn lame(&self) -> f64 {
        self.young * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson))
    }

    /// Speed of compression waves, sqrt((lambda + 2 G)/rho) (m/s).
    pub fn p_speed(&self) -> f64 {
        ((self.lame() + 2.0 * self.shear_modulus()) / self.density).sqrt()
    }

    /// Speed of shear waves, sqrt(G/rho) (m/s).
    pub fn s_speed(&self) -> f64 {
        (self.shear_modulus() / self.density).sqrt()
    }

    /// Speed of the Rayleigh wave (m/s): the zero of [`rayleigh_function`] beyond the shear slowness.
    ///
    /// Bisection on the slowness; the function has exactly one zero there, positive below it and
    /// negative above (Achenbach, Wave Propagation in Elastic Solids, 1973, section 5.11).
    pub fn rayleigh_speed(&self) -> f64 {
        let (a, b) = (1.0 / self.p_speed(), 1.0 / self.s_speed());
        // On the real axis beyond b both roots are imaginary and the function is real.
        let at = |p: f64| rayleigh_function(Complex64::new(p, 0.0), a, b).re;
        let (mut low, mut high) = (b, 2.0 * b);
        while at(high) > 0.0 {
            high *= 2.0;
        }
        // 200 halvings outlast the 53 bits of an f64; the interval stops shrinking before.
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if at(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        2.0 / (low + high)
    }
}

/// Vertical slowness sqrt(q^2 - p^2) (s/m) on the sheet Re >= 0, for horizontal slowness `p` and
/// body-wave slowness `q` (s/m).
///
/// Written as a product of roots: its cuts lie on the real axis beyond +-q, and a `p` on the right
/// cut (Im p = +0) takes the value of the upper side, -i sqrt(p^2 - q^2).
pub fn vertical_slowness(p: Complex64, q: f64) -> Complex64 {
    // q - p has imaginary part -0.0 or below on the upper side, so that the principal root turns down.
    let right = Complex64::new(q - p.re, -p.im.abs());
    let left = Complex64::new(q + p.re, p.im.abs());
    let upper = right.sqrt() * left.sqrt();
    if p.im < 0.0 { upper.conj() } else { upper }
}

/// Rayleigh's function (b^2 - 2 p^2)^2 + 4 p^2 sqrt(a^2 - p^2) sqrt(b^2 - p^2), with a, b the
/// slownesses of P and S (s/m); its real zeros are the slownesses of the Rayleigh wave.
pub fn rayleigh_function(p: Complex64, a: f64, b: f64) -> Complex64 {
    let square = p * p;
    let product = vertical_slowness(p, a) * vertical_slowness(p, b);
    if square.norm() < 4.0 * b * b {
        let chi = b * b - 2.0 * square;
        return chi * chi + 4.0 * square * product;
    }
    // Far out 4 p^4 cancels; p^2 + product, rationalised, does not.
    let sum = (a * a * b * b - (a * a + b * b) * square) / (product - square);
    b.powi(4) + 4.0 * square * (sum - b * b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_of_the_point_source_scene() {
        let rock = Elastic::new(2e9, 0.25, 2000.0).unwrap();
        assert!((rock.p_speed() - 1095.445).abs() < 1e-3);
        assert!((rock.s_speed() - 632.456).abs() < 1e-3);
        // Closed form at nu = 1/4: c_R = c_s sqrt(2 - 2/sqrt 3).
        let closed = rock.s_speed() * (2.0 - 2.0 / 3f64.sqrt()).sqrt();
        assert!((rock.rayleigh_speed() / closed - 1.0).abs() < 1e-14);
    }

    #[test]
    fn vertical_slowness_takes_the_upper_side_of_the_cut() {
        let below = vertical_slowness(Complex64::new(0.6, 0.0), 1.0);
        assert!((below - 0.8).norm() < 1e-15);
        let on_cut = vertical_slowness(Complex64::new(1.25, 0.0), 1.0);
        assert!((on_cut - Complex64::new(0.0, -0.75)).norm() < 1e-15);
        for p in [(0.3, 2.0), (1.7, 1e-9), (-1.7, 1e-9), (0.4, -3.0)] {
            let p = Complex64::new(p.0, p.1);
            let eta = vertical_slowness(p, 1.0);
            assert!((eta * eta - (1.0 - p * p)).norm() < 1e-12 * (1.0 + p.norm_sqr()));
            assert!(eta.re >= 0.0);
        }
    }

    #[test]
    fn rayleigh_function_is_continuous_and_grows_like_p_squared() {
        let (a, b) = (0.6, 1.0);
        for p in [Complex64::new(1.2, 1.6), Complex64::new(0.0, 2.0)] {
            let inside = rayleigh_function(p * (1.0 - 1e-15), a, b);
            let outside = rayleigh_function(p * (1.0 + 1e-15), a, b);
            assert!((inside / outside - 1.0).norm() < 1e-13);
        }
        let far = Complex64::new(3e6, 1e6);
        let leading = -2.0 * (b * b - a * a) * far * far;
        assert!((rayleigh_function(far, a, b) / leading - 1.0).norm() < 1e-11);
    }

    #[test]
    fn refuses_what_is_not_elastic() {
        assert_eq!(Elastic::new(-1.0, 0.3, 1.0).unwrap_err().field, "E");
        assert_eq!(Elastic::new(1.0, 0.5, 1.0).unwrap_err().field, "nu");
        assert_eq!(Elastic::new(1.0, 0.3, f64::NAN).unwrap_err().field, "rho");
    }
}
