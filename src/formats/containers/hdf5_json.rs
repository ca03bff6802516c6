//! Reads HDF5-JSON: HDF5 files written as JSON text, the format that current Scalismo saves.
//!
//! | member | holds |
//! |---|---|
//! | `apiVersion` | "1.0.0" by Scalismo, "1.1.1" by the converter; not looked at |
//! | `root` | id of the root group |
//! | `groups.{id}` | `links[{collection, id, title}]`, `attributes[{name, value}]`, `alias[]` |
//! | `datasets.{id}` | `shape{class, dims}`, `type`, `value`, `alias[]` |
//!
//! A member that would be empty may be missing. Paths follow the links from the root; what no link
//! leads to is found by its alias. A value is bare, or a list of one, or nested lists row by row.
//!
//! **Limits.** The types are not looked at: numbers are read in double precision. At most 10,000
//! groups and datasets, 16 groups inside one another, each group under one of its paths.
//!
//! **References.** The HDF Group, HDF5/JSON; unibas-gravis, scalismo-hdf5-json.

use std::collections::{BTreeMap, BTreeSet};

use crate::formats::containers::arrays::{Array, Data, trimmed};
use crate::formats::containers::json::{Document, Value};
use crate::formats::containers::tree::Tree;
use crate::formats::error::{Fault, shape_text};

const DEEPEST: usize = 16;
const MOST_PATHS: usize = 10_000;
const LONGEST_PATH: usize = 1000;

/// A file of this format, indexed.
#[derive(Debug)]
pub(crate) struct Hdf5Json<'a> {
    document: Document<'a>,
    /// Ids of the datasets by their path, without slashes around it.
    datasets: BTreeMap<String, String>,
    /// Attributes of the groups by their path.
    groups: BTreeMap<String, BTreeMap<String, Value>>,
}

impl<'a> Hdf5Json<'a> {
    /// Whether a document is of this format.
    pub(crate) fn knows(document: &Document<'_>) -> bool {
        document.has(&["datasets"]) && (document.has(&["root"]) || document.has(&["groups"]))
    }

    /// Follows the links of a document.
    pub(crate) fn new(document: Document<'a>) -> Result<Self, Fault> {
        let mut tree = Self { document, datasets: BTreeMap::new(), groups: BTreeMap::new() };
        if let Some(root) = tree.document.text(&["root"]) {
            tree.follow(&root, "", &mut BTreeSet::new())?;
        }
        tree.add_aliases()?;
        Ok(tree)
    }

    /// Visits a group once: links may form cycles.
    fn follow(
        &mut self,
        id: &str,
        path: &str,
        visited: &mut BTreeSet<String>,
    ) -> Result<(), Fault> {
        if visited.len() > MOST_PATHS || path.matches('/').count() > DEEPEST {
            return Ok(());
        }
        if !visited.insert(id.to_owned()) {
            return Ok(());
        }
        let links = self.document.read(&["groups", id, "links"], path)?;
        let attributes = self.attributes_of(id, path)?;
        self.groups.insert(path.to_owned(), attributes);
        for link in links.iter().flat_map(Value::items) {
            let part = |name: &str| link.get(name).and_then(Value::text);
            let (Some(title), Some(id)) = (part("title"), part("id")) else { continue };
            let inner = if path.is_empty() { title.to_owned() } else { format!("{path}/{title}") };
            let is_full = self.datasets.len() > MOST_PATHS || inner.len() > LONGEST_PATH;
            if is_full || self.groups.contains_key(&inner) {
                continue;
            }
            if part("collection") == Some("datasets") || self.document.has(&["datasets", id]) {
                self.datasets.insert(inner, id.to_owned());
            } else {
                self.follow(id, &inner, visited)?;
            }
        }
        Ok(())
    }

    fn attributes_of(&self, id: &str, path: &str) -> Result<BTreeMap<String, Value>, Fault> {
        let list = self.document.read(&["groups", id, "attributes"], path)?;
        let pair = |attribute: &Value| {
            let name = attribute.get("name")?.text()?.to_owned();
            Some((name, attribute.get("value")?.clone()))
        };
        Ok(list.iter().flat_map(Value::items).filter_map(pair).collect())
    }

    /// Adds objects that no link points to, under their own alias.
    fn add_aliases(&mut self) -> Result<(), Fault> {
        for collection in ["groups", "datasets"] {
            let ids: Vec<String> =
                self.document.names(&[collection]).take(MOST_PATHS).map(str::to_owned).collect();
            for id in ids {
                let Some(list) = self.document.read(&[collection, &id, "alias"], "alias")? else {
                    continue;
                };
                let Some(path) = list.items().first().and_then(Value::text) else { continue };
                let path = path.trim_matches('/').to_owned();
                if path.len() > LONGEST_PATH {
                    continue;
                }
                if self.groups.contains_key(&path) || self.datasets.contains_key(&path) {
                    continue;
                }
                if collection == "groups" {
                    let attributes = self.attributes_of(&id, &path)?;
                    self.groups.insert(path, attributes);
                } else {
                    self.datasets.insert(path, id);
                }
            }
        }
        Ok(())
    }

    /// Shape that a dataset announces; `None` when it does not.
    fn sides(&self, id: &str, path: &str) -> Option<Vec<usize>> {
        let shape = self.document.read(&["datasets", id, "shape"], path).ok()??;
        if shape.get("class").and_then(Value::text) == Some("H5S_SCALAR") {
            return Some(Vec::new());
        }
        let sides = shape.get("dims")?.clone().into_numbers()?.to_integers()?;
        sides.into_iter().map(|side| usize::try_from(side).ok()).collect()
    }
}

impl Tree for Hdf5Json<'_> {
    fn format(&self) -> &'static str {
        "HDF5-JSON file"
    }

    fn array(&self, path: &str) -> Result<Option<Array>, Fault> {
        let path = path.trim_matches('/');
        let Some(id) = self.datasets.get(path) else { return Ok(None) };
        let Some(value) = self.document.read(&["datasets", id, "value"], path)? else {
            return Ok(None);
        };
        let array = match value {
            Value::Numbers(array) => array,
            Value::Number(number) => Array { shape: Vec::new(), data: Data::F64(vec![number]) },
            Value::Text(text) => Array::text(text),
            Value::List(items) => {
                let texts: Vec<String> =
                    items.iter().filter_map(Value::text).map(str::to_owned).collect();
                if texts.len() < items.len() {
                    return Err(crate::formats::error::not_numbers(path, "records"));
                }
                Array { shape: vec![texts.len()], data: Data::Text(texts) }
            }
            Value::Null => return Ok(None),
            Value::Flag(_) | Value::Object(_) => {
                return Err(crate::formats::error::not_numbers(path, "something else"));
            }
        };
        let Some(sides) = self.sides(id, path) else { return Ok(Some(array)) };
        if sides.iter().try_fold(1_usize, |count, &side| count.checked_mul(side))
            != Some(array.data.len())
        {
            let (announced, found) = (shape_text(&sides), shape_text(&array.shape));
            let reason = format!("{announced} was announced and {found} is there");
            return Err(Fault::Damaged { what: path.to_owned(), reason });
        }
        Ok(Some(Array { shape: sides, data: array.data }))
    }

    fn has_array(&self, path: &str) -> bool {
        self.datasets.contains_key(path.trim_matches('/'))
    }

    fn attribute(&self, group: &str, name: &str) -> Option<String> {
        let value = self.groups.get(group.trim_matches('/'))?.get(name)?;
        value.text().or_else(|| value.items().first()?.text()).map(trimmed)
    }

    fn groups(&self, path: &str) -> Vec<String> {
        let path = path.trim_matches('/');
        let begin = if path.is_empty() { String::new() } else { format!("{path}/") };
        self.groups
            .range(begin.clone()..)
            .map_while(|(group, _)| group.strip_prefix(&begin))
            .filter(|rest| !rest.is_empty() && !rest.contains('/'))
            .map(str::to_owned)
            .collect()
    }

    fn contents(&self, most: usize) -> Vec<String> {
        let line = |(path, id): (&String, &String)| match self.sides(id, path) {
            Some(sides) => format!("{path} ({})", shape_text(&sides)),
            None => path.clone(),
        };
        self.datasets.iter().take(most).map(line).collect()
    }

    fn cut_off(&self) -> Option<Fault> {
        None
    }
}
