//! Demo models, by name.
//!
//! `stars-1-a` … `stars-6-b` and `planes-a`, `planes-b` are made by code, `wings-aedes` and `wings-culex` of landmarks
//! that the engine carries (`demos/wings`). The heads are packaged files (`demos/heads`): the command line carries
//! them, the page fetches them.

mod planes;
mod stars;
mod wings;

pub use planes::{PlanesAt, planes_at};
pub use stars::{
    ROWS as STAR_ROWS, StarRow, exclusive_stars, intersection as star_intersection, star_pair,
};

use crate::model::LinearModel;

/// The packaged models, by the second half of their name.
pub const HEADS: [&str; 4] = ["male", "female", "identity", "expression"];

/// The demo model `name` where it is made here; `None` for the heads and unknown names.
pub fn generated(name: &str) -> Option<LinearModel> {
    let model = match name {
        "planes-a" => planes_at(PlanesAt::default()).0,
        "planes-b" => planes_at(PlanesAt::default()).1,
        "wings-aedes" => wings::wings()?[0].clone(),
        "wings-culex" => wings::wings()?[1].clone(),
        _ => {
            let (row, which) = name.strip_prefix("stars-")?.split_once('-')?;
            let row = *STAR_ROWS.get(row.parse::<usize>().ok()?.checked_sub(1)?)?;
            let (a, b) = star_pair(row);
            match which {
                "a" => a,
                "b" => b,
                _ => return None,
            }
        }
    };
    Some(model.with_name(name))
}

/// All names, in the order in which they are offered.
pub fn names() -> Vec<String> {
    let stars =
        (1..=STAR_ROWS.len()).flat_map(|row| [format!("stars-{row}-a"), format!("stars-{row}-b")]);
    let planes = ["planes-a", "planes-b"].map(String::from);
    let wings = wings::GENERA.map(|(genus, _)| format!("wings-{genus}"));
    let heads = HEADS.iter().map(|name| format!("heads-{name}"));
    stars.chain(planes).chain(wings).chain(heads).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_generated_name_opens_and_others_do_not() {
        for name in names().iter().filter(|name| !name.starts_with("heads-")) {
            assert_eq!(generated(name).map(|m| m.name().to_owned()).as_ref(), Some(name), "{name}");
        }
        for name in
            ["stars-0-a", "stars-7-a", "stars-1-c", "stars-", "moon", "wings-moth", "heads-male"]
        {
            assert!(generated(name).is_none(), "{name}");
        }
    }
}
