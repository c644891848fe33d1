//! `--over FIELD=VALUES`: the values of a field, of several fields that have the same, or of fields
//! that advance together.
//!
//! ```text
//! grid.h_m=40,20,10                                    a list
//! pml.thickness_m=200..2000:200                        a range: from, to (included), step
//! pml.thickness_m,damping-layer.thickness_m=200,400    two fields with the same values
//! pml-stretched.alpha=0.8..8:0.8/pml-stretched.thickness_m=200..2000:200    in pairs
//! ```

use super::Setting;
use crate::error::CaseError;

/// The values of one or several fields.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    clauses: Vec<Clause>,
}

/// Fields that have the same values.
#[derive(Clone, Debug, PartialEq)]
struct Clause {
    fields: Vec<String>,
    values: Vec<String>,
}

/// More values than this are a slip of the step.
const MOST: usize = 1000;

impl Axis {
    /// Reads the text after `--over`.
    ///
    /// # Errors
    /// [`CaseError::Usage`] with what is expected.
    pub fn parse(text: &str) -> Result<Self, CaseError> {
        let wrong = |what: String| {
            CaseError::Usage(format!(
                "--over {text}: {what}; expected a field and its values, for example --over pml.thickness_m=200..2000:200 or --over basis=linear,bspline; fields that advance together are joined by `/`"
            ))
        };
        let clauses = text
            .split('/')
            .map(|clause| Clause::parse(clause).map_err(wrong))
            .collect::<Result<Vec<_>, _>>()?;
        let lengths: Vec<usize> = clauses.iter().map(|clause| clause.values.len()).collect();
        if let Some(other) = lengths.iter().find(|n| **n != lengths[0]) {
            return Err(wrong(format!(
                "{} values cannot be paired with {other}",
                lengths[0]
            )));
        }
        let axis = Axis { clauses };
        let labels: Vec<String> = axis.settings().into_iter().map(|s| s.label).collect();
        match (1..labels.len()).find(|i| labels[..*i].contains(&labels[*i])) {
            Some(i) => Err(wrong(format!("{} stands there twice", labels[i]))),
            None => Ok(axis),
        }
    }

    /// The fields.
    pub fn fields(&self) -> Vec<&str> {
        let fields = self.clauses.iter().flat_map(|clause| &clause.fields);
        fields.map(String::as_str).collect()
    }

    /// Its points, in their order.
    pub fn settings(&self) -> Vec<Setting> {
        let count = self.clauses.first().map_or(0, |clause| clause.values.len());
        (0..count)
            .map(|i| Setting {
                label: self.joined(|clause| format!("{}={}", clause.name(), clause.values[i])),
                value: self.clauses[0].values[i].parse().ok(),
                sets: self
                    .clauses
                    .iter()
                    .flat_map(|clause| {
                        let value = &clause.values[i];
                        let set = |field: &String| format!("{field}={value}");
                        clause.fields.iter().map(set).collect::<Vec<_>>()
                    })
                    .collect(),
            })
            .collect()
    }

    /// What is varied, in short.
    pub fn name(&self) -> String {
        self.joined(|clause| clause.name().to_owned())
    }

    fn joined(&self, text: impl Fn(&Clause) -> String) -> String {
        self.clauses.iter().map(text).collect::<Vec<_>>().join(",")
    }
}

impl Clause {
    fn parse(text: &str) -> Result<Self, String> {
        let (fields, values) = text.split_once('=').ok_or("there is no `=`")?;
        let words = |list: &str| -> Vec<String> {
            list.split(',').map(|word| word.trim().to_owned()).collect()
        };
        let fields = words(fields);
        if fields.iter().any(String::is_empty) {
            return Err("a field has no name".into());
        }
        let mut all = Vec::new();
        for word in words(values) {
            match word.split_once("..") {
                Some((from, rest)) => all.extend(range(&word, from, rest)?),
                None if word.is_empty() => return Err("a value is missing".into()),
                None => all.push(word),
            }
        }
        Ok(Clause {
            fields,
            values: all,
        })
    }

    /// The field, or what is common to the ends of several.
    fn name(&self) -> &str {
        let first = &self.fields[0];
        let last = first.rsplit('.').next().unwrap_or(first);
        let common = self.fields.len() > 1
            && self
                .fields
                .iter()
                .all(|f| f.rsplit('.').next() == Some(last));
        if common { last } else { first }
    }
}

/// `FROM..TO:STEP`, both ends included.
fn range(word: &str, from: &str, rest: &str) -> Result<Vec<String>, String> {
    let (to, step) = rest
        .split_once(':')
        .ok_or(format!("the range {word} has no step (`:STEP`)"))?;
    let number = |text: &str| {
        let number = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        number.ok_or(format!("`{}` is no number", text.trim()))
    };
    let (from, to, step) = (number(from)?, number(to)?, number(step)?);
    if step <= 0.0 || to <= from {
        return Err(format!("the range {word} does not go up"));
    }
    // Half a millionth of a step is rounding.
    let count = ((to - from) / step + 5e-7).floor() as usize + 1;
    if count > MOST {
        return Err(format!(
            "the range {word} has {count} values, more than {MOST}"
        ));
    }
    // Ten digits rid sums of their rounding.
    let rounded = |x: f64| format!("{x:.9e}").parse::<f64>().unwrap_or(x);
    let value = |i: usize| rounded(from + i as f64 * step).to_string();
    Ok((0..count).map(value).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(text: &str) -> Vec<String> {
        let settings = Axis::parse(text).unwrap().settings();
        settings.into_iter().map(|s| s.label).collect()
    }

    #[test]
    fn lists_ranges_and_words() {
        assert_eq!(labels("grid.h_m=40, 20"), ["grid.h_m=40", "grid.h_m=20"]);
        let beta = labels("pml-stretched.alpha=0.8..2.4:0.8");
        assert_eq!(beta.len(), 3);
        assert_eq!(beta[2], "pml-stretched.alpha=2.4");
        assert_eq!(
            labels("basis=linear,bspline"),
            ["basis=linear", "basis=bspline"]
        );
        assert_eq!(labels("time.dt_s=1e-3,2e-3")[0], "time.dt_s=1e-3");
    }

    #[test]
    fn fields_share_values_or_advance_together() {
        let axis = Axis::parse("pml.thickness_m,damping-layer.thickness_m=200,400").unwrap();
        let first = &axis.settings()[0];
        assert_eq!(first.label, "thickness_m=200");
        assert_eq!(
            first.sets,
            ["pml.thickness_m=200", "damping-layer.thickness_m=200"]
        );
        let paired = Axis::parse("s.alpha=1..3:1/s.thickness_m=10..30:10").unwrap();
        let last = &paired.settings()[2];
        assert_eq!(last.sets, ["s.alpha=3", "s.thickness_m=30"]);
        assert_eq!(
            (last.label.as_str(), last.value),
            ("s.alpha=3,s.thickness_m=30", Some(3.0))
        );
    }

    #[test]
    fn what_is_no_axis_is_refused() {
        for (text, part) in [
            ("grid.h_m", "there is no `=`"),
            ("=3", "a field has no name"),
            ("grid.h_m=1,,2", "a value is missing"),
            ("grid.h_m=1,1", "grid.h_m=1 stands there twice"),
            ("grid.h_m=1..3", "has no step"),
            ("grid.h_m=3..1:1", "does not go up"),
            ("grid.h_m=1..x:1", "`x` is no number"),
            ("grid.h_m=1..3:1e-9", "more than 1000"),
            ("a=1,2/b=1,2,3", "2 values cannot be paired with 3"),
        ] {
            let error = Axis::parse(text).unwrap_err().to_string();
            assert!(error.contains(part) && error.contains(text), "{error}");
        }
    }
}
