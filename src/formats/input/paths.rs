//! File names as paths: folder, extension, system files to ignore, natural sort order.

use core::cmp::Ordering;

use super::Input;

/// Files without those that systems leave behind, in natural order.
pub(crate) fn in_order(inputs: &[Input]) -> Vec<Input> {
    let mut inputs: Vec<Input> =
        inputs.iter().filter(|input| !is_junk(&input.name)).cloned().collect();
    inputs.sort_by(|a, b| natural_order(&a.name, &b.name));
    inputs
}

/// What systems and programs leave behind in folders and archives.
pub(crate) fn is_junk(name: &str) -> bool {
    name.split('/').any(|part| {
        part.len() > 1 && part.starts_with('.') && part != ".."
            || ["__MACOSX", "Thumbs.db", "desktop.ini"].contains(&part)
    })
}

/// The folder of a path, "" at the top.
pub(crate) fn folder(name: &str) -> &str {
    name.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// A file's name up to its ending, that of compression not counted.
pub(crate) fn stem(file_name: &str) -> &str {
    let name = file_name.strip_suffix(".gz").unwrap_or(file_name);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// The extension, in lower case.
pub(crate) fn ending(name: &str) -> String {
    let name = name.strip_suffix(".gz").unwrap_or(name);
    name.rsplit_once('.').map_or(String::new(), |(_, ending)| ending.to_lowercase())
}

/// Sorts indices of files by their names, in natural order.
pub(crate) fn sort_naturally(files: &mut [usize], inputs: &[Input]) {
    files.sort_by(|&a, &b| natural_order(&inputs[a].name, &inputs[b].name));
}

/// Natural order of file names: by text, but by value where both have digits.
fn natural_order(a: &str, b: &str) -> Ordering {
    let (mut left, mut right) = (a.as_bytes(), b.as_bytes());
    loop {
        let (Some(&first), Some(&second)) = (left.first(), right.first()) else {
            return left.len().cmp(&right.len()).then_with(|| a.cmp(b));
        };
        if first.is_ascii_digit() && second.is_ascii_digit() {
            let digits = |text: &[u8]| {
                text.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(text.len())
            };
            let ((x, after_x), (y, after_y)) =
                (left.split_at(digits(left)), right.split_at(digits(right)));
            let value = |digits: &[u8]| {
                let zeros = digits.iter().take_while(|byte| **byte == b'0').count();
                digits[zeros..].to_vec()
            };
            let (x, y) = (value(x), value(y));
            let order = x.len().cmp(&y.len()).then_with(|| x.cmp(&y));
            if order != Ordering::Equal {
                return order;
            }
            (left, right) = (after_x, after_y);
        } else {
            let order = first.to_ascii_lowercase().cmp(&second.to_ascii_lowercase());
            if order != Ordering::Equal {
                return order;
            }
            (left, right) = (&left[1..], &right[1..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn people_count_2_before_10() {
        for (first, second) in [("2.ply", "10.ply"), ("a02", "a2b"), ("A1", "b1"), ("a", "a1")] {
            assert_eq!(natural_order(first, second), Ordering::Less, "{first} {second}");
            assert_eq!(natural_order(second, first), Ordering::Greater, "{second} {first}");
        }
        assert_eq!(natural_order("a1", "a1"), Ordering::Equal, "the same");
    }
}
