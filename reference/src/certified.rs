//! The certified references that come with the program: the same scheme on a domain so large that
//! nothing comes back in time, stored because they are dear.
//!
//! A reference is a family of tables `CASE-HASH*.csv` in `data/certified`; the hash is that of
//! everything that its series depend on. What the comment lines hold is the case runner's business,
//! which writes and reads them; here they are found.

/// Name and text of each stored table.
static TABLES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/certified.rs"));

/// The text of the stored table called `name`.
pub fn table(name: &str) -> Option<&'static str> {
    let found = TABLES.iter().find(|(known, _)| *known == name);
    found.map(|(_, text)| *text)
}

/// Names of all stored tables, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    TABLES.iter().map(|(name, _)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stored::Table;

    #[test]
    fn every_table_is_whole_and_small() {
        for name in names() {
            let text = table(name).unwrap();
            Table::parse(name, text).unwrap();
            assert!(text.len() < 1_000_000, "{name} has {} bytes", text.len());
        }
    }

    #[test]
    fn unknown_names_are_not_found() {
        assert_eq!(table("point-source-0.csv"), None);
    }
}
