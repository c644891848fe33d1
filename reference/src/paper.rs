//! Numbers as the papers print them: shown beside our own as evidence `paper`, never as verification.

/// A paper that the project reproduces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paper {
    /// Short name in reports.
    pub short: &'static str,
    /// Authors, year, title, journal.
    pub citation: &'static str,
    /// Digital object identifier.
    pub doi: &'static str,
}

/// Absorbing particles of the perfectly matched layer in implicit MPM.
pub const K25: Paper = Paper {
    short: "K25",
    citation: "Kurima, Chandra, Soga 2025, Absorbing boundary conditions in material point method adopting perfectly matched layer theory, Soil Dynamics and Earthquake Engineering",
    doi: "10.1016/j.soildyn.2025.109219",
};

/// Dashpot and damping layer in explicit GIMP MPM.
pub const S21: Paper = Paper {
    short: "S21",
    citation: "Shan, Liao, Dong, Wang, Cui 2021, Implementation of absorbing boundary conditions in dynamic simulation of the material point method, Journal of Zhejiang University-SCIENCE A",
    doi: "10.1631/jzus.A2000399",
};

/// How a printed number is meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Printed {
    /// A value.
    Equals(f64),
    /// An upper bound.
    Below(f64),
}

/// One printed number, named like a row of `summary.json`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaperValue {
    /// Whose number.
    pub paper: Paper,
    /// Section or figure.
    pub section: &'static str,
    /// Case, for example `point-source`.
    pub case: &'static str,
    /// Load or variant of the case; empty if there is one only.
    pub variant: &'static str,
    /// Boundary method; empty where the number holds for all.
    pub method: &'static str,
    /// Metric id.
    pub metric: &'static str,
    /// Receiver or group.
    pub place: &'static str,
    /// The number, in `unit`; ratios as numbers, not per cent.
    pub printed: Printed,
    /// SI unit; ratios have `1`.
    pub unit: &'static str,
    /// What the paper leaves open or says otherwise.
    pub remark: &'static str,
}

impl PaperValue {
    /// The number without its meaning.
    pub fn value(&self) -> f64 {
        match self.printed {
            Printed::Equals(value) | Printed::Below(value) => value,
        }
    }
}

/// Every number that is kept.
pub const VALUES: [PaperValue; 15] = [
    k25("Test 1", "A", 0.10),
    k25("Test 1", "B", 0.121),
    k25("Test 1", "C", 0.1196),
    k25("Test 2", "A", 0.0724),
    k25("Test 2", "B", 0.0981),
    k25("Test 2", "C", 0.0769),
    k25("Test 3", "A", 0.101),
    k25("Test 3", "B", 0.135),
    k25("Test 3", "C", 0.116),
    s21_residual("dashpot", "A"),
    s21_residual("dashpot", "B"),
    s21_residual("damping-layer", "A"),
    s21_residual("damping-layer", "B"),
    PaperValue {
        method: "",
        metric: "travel_time_s",
        place: "A to B",
        printed: Printed::Equals(0.7),
        unit: "s",
        remark: "read off a figure; from height 50 m to 5 m",
        ..s21_residual("", "")
    },
    PaperValue {
        method: "",
        metric: "p_speed_m_s",
        place: "column",
        printed: Printed::Equals(63.0),
        unit: "m/s",
        remark: "needs nu = 0.49; the printed nu = 0.3 gives 17.6 m/s; its 0.7 s are said to hint 64 m/s",
        ..s21_residual("", "")
    },
];

/// The numbers of `case` printed by any paper.
pub fn values_of(case: &str) -> impl Iterator<Item = &'static PaperValue> {
    VALUES.iter().filter(move |value| value.case == case)
}

const fn k25(test: &'static str, group: &'static str, ratio: f64) -> PaperValue {
    PaperValue {
        paper: K25,
        section: "3.1",
        case: "point-source",
        variant: test,
        method: "pml-stretched",
        metric: "amplitude_ratio",
        place: group,
        printed: Printed::Equals(ratio),
        unit: "1",
        remark: "against the standard run after 5 s, mean of the group; source place, pulse and geometry are not fully printed",
    }
}

const fn s21_residual(method: &'static str, receiver: &'static str) -> PaperValue {
    PaperValue {
        paper: S21,
        section: "3.1",
        case: "compression-1d",
        variant: "",
        method,
        metric: "residual",
        place: receiver,
        printed: Printed::Below(0.15),
        unit: "1",
        remark: "printed for t = 3 s, when both points rest even above a roller; a maximum over 3..4 s is meant",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::elastic::Elastic;

    #[test]
    fn every_number_is_named_once() {
        let key = |v: &PaperValue| (v.case, v.variant, v.method, v.metric, v.place);
        for (i, value) in VALUES.iter().enumerate() {
            assert!(value.value().is_finite() && value.value() > 0.0);
            assert!(VALUES[..i].iter().all(|other| key(other) != key(value)));
        }
        assert_eq!(values_of("point-source").count(), 9);
        assert_eq!(values_of("compression-1d").count(), 6);
    }

    #[test]
    fn speed_and_travel_time_fit_the_closed_form() {
        let c = Elastic::new(150e3, 0.49, 650.0).unwrap().p_speed();
        let of = |metric| values_of("compression-1d").find(|v| v.metric == metric);
        // Printed with two digits and one.
        assert!((of("p_speed_m_s").unwrap().value() - c).abs() < 0.5);
        assert!((of("travel_time_s").unwrap().value() - 45.0 / c).abs() < 0.05);
    }
}
