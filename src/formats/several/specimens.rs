//! Names the specimens of a population, leaves out, mirrors and rescales those that the reading says, and finds what is
//! unusual about the others: missing landmarks, mirrored specimens, other sizes, outliers.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DMatrixView};

use crate::formats::condition::{Condition, Test, number};
use crate::formats::error::{Fault, counted};
use crate::formats::landmarks::Specimen;
use crate::formats::mesh::MissingPoint;
use crate::formats::reading::{
    Choice, Finding, FirstColumn, Missing, Reading, SIZE, covariate_name,
};
use crate::formats::several::table::{ColumnKind, Columns, SideTable, SpecimenRow, SpecimenTable};
use crate::model::{Cells, PointOrder, centroid_size, look, reflect, remove_within_groups};
use crate::text::{listed, thousands, three_digits};

/// Numbers that mark a missing landmark when all coordinates have them.
const MARKS: [f64; 10] = [0.0, -1.0, -9.0, -99.0, -999.0, -9999.0, 99.0, 999.0, 9999.0, 99_999.0];

/// Sets of more points are meshes, of which none is missing.
const MOST_LANDMARKS: usize = 2000;

/// Procrustes distance from which a note says what it means for a linear model: sin ρ is 2 % less than ρ.
const WIDE: f64 = 0.35;

/// Specimens named in a sentence.
const NAMED: usize = 6;

/// The specimens of a population, in the order of their files.
#[derive(Debug, Default)]
pub(crate) struct Specimens {
    reading: Reading,
    /// Name of the file that each has to itself, or what its file calls it; else it is called by its number.
    names: Vec<Option<String>>,
    /// What is known of each.
    columns: Columns,
    /// Numbers of those that are left, from 0.
    left: Vec<usize>,
    /// Missing points of each, before any is left out.
    missing: Vec<Vec<MissingPoint>>,
    /// Numbers of the points that are left.
    points: Vec<usize>,
    /// Whether a first column that counts was left out.
    numbered: bool,
}

/// What is left of a population.
pub(crate) struct Chosen {
    pub(crate) shapes: DMatrix<f64>,
    pub(crate) cells: Cells,
    pub(crate) notes: Vec<String>,
}

impl Specimens {
    /// None yet, to be read in this way.
    pub(crate) fn new(reading: &Reading) -> Self {
        Self { reading: reading.clone(), ..Self::default() }
    }

    /// How they are to be read.
    pub(crate) fn reading(&self) -> &Reading {
        &self.reading
    }

    /// One more, with its own file if it has one.
    pub(crate) fn add(&mut self, file: Option<&str>, specimen: &mut Specimen) {
        self.left.push(self.names.len());
        // A number of its own would be taken for its place.
        let said = specimen.name.take().filter(|name| name.parse::<f64>().is_err());
        self.names.push(file.map(str::to_owned).or(said));
        self.columns.add(core::mem::take(&mut specimen.columns));
        self.missing.push(core::mem::take(&mut specimen.mesh.missing));
        self.numbered |= specimen.mesh.numbered;
    }

    /// Takes the columns of a table beside the set. Returns a note.
    pub(crate) fn join(&mut self, file: &str, table: &SideTable) -> String {
        let numbers: Vec<String> =
            (1..=self.names.len()).map(|number| number.to_string()).collect();
        let names: Vec<Vec<&str>> = self
            .names
            .iter()
            .zip(&numbers)
            .map(|(name, number)| name.as_deref().into_iter().chain([number.as_str()]).collect())
            .collect();
        self.columns.join(file, table, &names)
    }

    /// What a reading calls a specimen: its file where that is a word of its own, else its number.
    fn key(&self, specimen: usize) -> String {
        match &self.names[specimen] {
            Some(file)
                if !file.contains([' ', ',', ':', '=', ';', '"'])
                    && file.parse::<usize>().is_err()
                    && self.names.iter().filter(|other| other.as_ref() == Some(file)).count()
                        == 1 =>
            {
                file.clone()
            }
            _ => (specimen + 1).to_string(),
        }
    }

    /// What a sentence calls a specimen.
    fn called(&self, specimen: usize) -> String {
        self.names[specimen].clone().unwrap_or_else(|| format!("specimen {}", specimen + 1))
    }

    fn list(&self, specimens: &[usize]) -> String {
        let names: Vec<String> =
            specimens.iter().take(NAMED).map(|&specimen| self.called(specimen)).collect();
        match specimens.len() {
            0..=NAMED => listed(names.iter().map(String::as_str)),
            more => format!("{} and {} more", names.join(", "), more - NAMED),
        }
    }

    /// Its number from 0.
    fn numbered_by(&self, name: &str) -> Result<usize, Fault> {
        let number = name.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        let by_file = || self.names.iter().position(|file| file.as_deref() == Some(name));
        number.filter(|number| *number < self.names.len()).or_else(by_file).ok_or_else(|| {
            let named: Vec<&str> = self.names.iter().flatten().map(String::as_str).collect();
            let found = match named.as_slice() {
                [first, .., last] => format!("{} specimens, {first} to {last}", self.names.len()),
                _ => format!("{} specimens", self.names.len()),
            };
            Fault::NoSpecimen { wanted: name.to_owned(), found }
        })
    }

    fn numbers(&self, names: &[String]) -> Result<Vec<usize>, Fault> {
        let mut numbers: Vec<usize> =
            names.iter().map(|name| self.numbered_by(name)).collect::<Result<_, _>>()?;
        numbers.sort_unstable();
        numbers.dedup();
        Ok(numbers)
    }

    /// Adds to `without` those that the reading does not ask for, and those that are in no group of the column that
    /// divides them, or of which the covariate is not known. Returns notes.
    fn leave_out_others(&self, without: &mut Vec<usize>) -> Result<Vec<String>, Fault> {
        let mut notes = Vec::new();
        let mut kept: Vec<usize> =
            (0..self.names.len()).filter(|specimen| !without.contains(specimen)).collect();
        for condition in &self.reading.only {
            let holding = self.columns.holding(condition, &kept)?;
            notes.push(format!(
                "Read of {} with {}: {}.",
                counted(kept.len(), "specimen", "specimens"),
                condition.sentence(),
                thousands(holding.len())
            ));
            kept = holding;
        }
        if let Some(group) = &self.reading.group {
            // Whether there is such a group at all is told before anything is left out.
            self.columns.holding(group, &kept)?;
            let opposite = group.opposite();
            let in_one = |word: &str| group.holds(word) || opposite.holds(word);
            kept = self.with_known(&group.column, &kept, in_one, &mut notes)?;
        }
        if let Some(column) = self.reading.adjust.as_deref().filter(|column| *column != SIZE) {
            kept = self.with_known(column, &kept, |word| number(word).is_some(), &mut notes)?;
            if kept.is_empty() {
                let reason = "it is not a number for any specimen".to_owned();
                return Err(Fault::Covariate { column: column.to_owned(), reason });
            }
        }
        if kept.len() + without.len() < self.names.len() {
            *without =
                (0..self.names.len()).filter(|one| kept.binary_search(one).is_err()).collect();
        }
        Ok(notes)
    }

    /// Those of `kept` whose word in a column `holds`; a note names the others.
    fn with_known(
        &self,
        column: &str,
        kept: &[usize],
        holds: impl Fn(&str) -> bool,
        notes: &mut Vec<String>,
    ) -> Result<Vec<usize>, Fault> {
        let words = self.columns.words(column)?;
        let (with, lacking): (Vec<usize>, Vec<usize>) =
            kept.iter().partition(|&&specimen| holds(words[specimen]));
        if !lacking.is_empty() {
            notes.push(format!("Left out without {column}: {}.", self.list(&lacking)));
        }
        Ok(with)
    }

    /// Takes the regression on the covariate of the reading out of aligned shapes, within the groups of the column that
    /// divides them; `sizes` are the centroid sizes before they were aligned. Returns a note.
    pub(crate) fn adjust(
        &self,
        shapes: &mut DMatrix<f64>,
        sizes: &[f64],
    ) -> Result<Option<String>, Fault> {
        let Some(column) = &self.reading.adjust else { return Ok(None) };
        let covariate: Vec<f64> = if column == SIZE {
            sizes.iter().map(|size| libm::log(*size)).collect()
        } else {
            let words = self.columns.words(column)?;
            self.left.iter().filter_map(|&specimen| number(words[specimen])).collect()
        };
        let groups = self.partition()?;
        let fault = |reason: &str| Fault::Covariate {
            column: covariate_name(column).to_owned(),
            reason: reason.to_owned(),
        };
        if covariate.len() != shapes.ncols() || covariate.iter().any(|x| !x.is_finite()) {
            return Err(fault("it is not a number for every specimen"));
        }
        let share = remove_within_groups(shapes, &covariate, &groups)
            .ok_or_else(|| fault("it does not differ within the groups"))?;
        let within = match &self.reading.group {
            Some(group) => format!("within the groups of {}", group.column),
            None => "of all specimens".to_owned(),
        };
        Ok(Some(format!(
            "The regression on {} {within} was taken out, {} % of the variance there: shapes are those at the mean of all.",
            covariate_name(column),
            three_digits(100.0 * share)
        )))
    }

    /// The number of the group of each specimen that is left: by the words of the column that divides them, or the two
    /// sides of a threshold.
    fn partition(&self) -> Result<Vec<usize>, Fault> {
        let Some(group) = &self.reading.group else { return Ok(vec![0; self.left.len()]) };
        let words = self.columns.words(&group.column)?;
        let mut known: BTreeMap<&str, usize> = BTreeMap::new();
        Ok(self
            .left
            .iter()
            .map(|&specimen| match group.test {
                Test::Below(_) | Test::From(_) => usize::from(group.holds(words[specimen])),
                Test::Is(_) | Test::IsNot(_) => {
                    let next = known.len();
                    *known.entry(words[specimen]).or_insert(next)
                }
            })
            .collect())
    }

    /// The places of the shapes of the group that the reading asks for, among those that are left; `None` for all.
    pub(crate) fn group(&self) -> Result<Option<(&Condition, Vec<usize>)>, Fault> {
        let Some(group) = &self.reading.group else { return Ok(None) };
        let holding = self.columns.holding(group, &self.left)?;
        let places = (0..self.left.len())
            .filter(|place| holding.binary_search(&self.left[*place]).is_ok())
            .collect();
        Ok(Some((group, places)))
    }

    /// What the files say of the specimens, with models to make of it.
    pub(crate) fn columns_finding(&self) -> Option<Finding> {
        const MOST_CHOICES: usize = 6;
        let columns = self.columns.all();
        let divides = columns.iter().any(|column| column.kind != ColumnKind::Names);
        if !divides || self.reading.group.is_some() {
            return None;
        }
        let message = format!("Of the specimens is known: {}.", self.columns.described());
        let choices = columns
            .iter()
            .filter(|column| column.kind == ColumnKind::Groups && column.values.len() > 1)
            .flat_map(|column| {
                column.values.iter().filter(|value| value.count >= 3).map(|value| Condition {
                    column: column.name.clone(),
                    test: Test::Is(value.word.clone()),
                })
            })
            .take(MOST_CHOICES)
            .map(|group| {
                let label = format!("Only {}", group.sentence());
                self.reading.choice(label, |to| to.group = Some(group))
            })
            .collect();
        Some(Finding::new("columns", message, choices).sure())
    }

    /// The table of all specimens; `shapes` has them as they are in their files, with SCALE (d·n × N).
    pub(crate) fn table(&self, dimension: usize, shapes: &DMatrix<f64>) -> SpecimenTable {
        let columns = self.columns.all();
        let words: Vec<Vec<&str>> = columns
            .iter()
            .map(|column| self.columns.words(&column.name).unwrap_or_default())
            .collect();
        let specimens = (0..self.names.len())
            .map(|specimen| {
                let size = centroid_size(shapes.column(specimen).as_slice(), dimension);
                SpecimenRow {
                    key: self.key(specimen),
                    name: self.called(specimen),
                    size: Some(size).filter(|size| size.is_finite()),
                    missing: self.missing[specimen].len(),
                    kept: self.left.binary_search(&specimen).is_ok(),
                    values: words.iter().map(|words| words[specimen].to_owned()).collect(),
                }
            })
            .collect();
        SpecimenTable { dimension, points: shapes.nrows() / dimension, specimens, columns }
    }

    /// Carries out what the reading says about shapes (d·n × N), and refuses them when landmarks are missing and it says
    /// nothing about that.
    pub(crate) fn choose(
        &mut self,
        dimension: usize,
        mut shapes: DMatrix<f64>,
        cells: Cells,
    ) -> Result<Chosen, Fault> {
        let points = shapes.nrows() / dimension;
        let mut without = self.numbers(&self.reading.without)?;
        let mut notes = self.leave_out_others(&mut without)?;
        let mut without_points = Vec::new();
        for &number in &self.reading.without_points {
            if number > points {
                let found = format!("{} points", thousands(points));
                return Err(Fault::NoSpecimen { wanted: format!("point {number}"), found });
            }
            without_points.push(number - 1);
        }
        for (list, backwards) in [(&self.reading.start, false), (&self.reading.reverse, true)] {
            for (name, first) in list {
                if *first > points {
                    let found = format!("{} points", thousands(points));
                    return Err(Fault::NoSpecimen { wanted: format!("point {first}"), found });
                }
                let order = PointOrder { first: first - 1, backwards };
                let mut shape = shapes.column_mut(self.numbered_by(name)?);
                let other = order.reorder(shape.as_slice(), dimension);
                shape.copy_from_slice(&other);
            }
        }
        for (name, factor) in &self.reading.rescale {
            let mut shape = shapes.column_mut(self.numbered_by(name)?);
            shape *= *factor;
        }
        for specimen in self.numbers(&self.reading.mirror)? {
            reflect(shapes.column_mut(specimen).as_mut_slice(), dimension);
        }
        let left_out = |specimen: usize, point: usize, without: &[usize], points: &[usize]| {
            without.contains(&specimen) || points.contains(&point)
        };
        let gone: Vec<(usize, usize)> = self
            .missing
            .iter()
            .enumerate()
            .flat_map(|(specimen, missing)| missing.iter().map(move |gap| (specimen, gap.point)))
            .filter(|&(specimen, point)| !left_out(specimen, point, &without, &without_points))
            .collect();
        if !gone.is_empty() {
            match self.reading.missing {
                Some(Missing::Specimens) => {
                    let mut left_out: Vec<usize> = gone.iter().map(|(one, _)| *one).collect();
                    left_out.dedup();
                    notes
                        .push(format!("Left out for missing landmarks: {}.", self.list(&left_out)));
                    without.extend(left_out);
                }
                Some(Missing::Points) => {
                    let mut left_out: Vec<usize> = gone.iter().map(|(_, point)| *point).collect();
                    left_out.sort_unstable();
                    left_out.dedup();
                    notes.push(format!(
                        "Left out because a specimen lacks them: {}.",
                        landmarks(&left_out)
                    ));
                    without_points.extend(left_out);
                }
                _ => return Err(self.missing_fault(&gone, points)),
            }
        }
        self.left = (0..shapes.ncols()).filter(|specimen| !without.contains(specimen)).collect();
        self.points = (0..points).filter(|point| !without_points.contains(point)).collect();
        if self.points.is_empty() {
            let found = format!("{} points, all of which are left out", thousands(points));
            return Err(Fault::NoSpecimen { wanted: "point that is left".to_owned(), found });
        }
        let whole = self.left.len() == shapes.ncols() && self.points.len() == points;
        if whole {
            return Ok(Chosen { shapes, cells, notes });
        }
        let rows: Vec<usize> = self
            .points
            .iter()
            .flat_map(|point| (0..dimension).map(move |axis| point * dimension + axis))
            .collect();
        let kept: Vec<u32> = (0_u32..)
            .zip(0..points)
            .filter(|(_, point)| self.points.binary_search(point).is_ok())
            .map(|(number, _)| number)
            .collect();
        let shapes = shapes.select_columns(&self.left).select_rows(&rows);
        let cells = cells.at_points(&kept, points);
        Ok(Chosen { shapes, cells, notes })
    }

    /// Finds numbers that mark missing landmarks: a point with the same such number in all coordinates, which lies
    /// elsewhere than in the other specimens, or of which a specimen has two.
    pub(crate) fn find_marks(&mut self, dimension: usize, shapes: DMatrixView<'_, f64>) {
        if self.reading.missing == Some(Missing::Values)
            || shapes.nrows() / dimension > MOST_LANDMARKS
        {
            return;
        }
        let mut doubted: BTreeMap<(usize, usize), f64> = BTreeMap::new();
        for (specimen, shape) in shapes.column_iter().enumerate() {
            for (point, place) in (0..shape.len()).step_by(dimension).enumerate() {
                let first = shape[place];
                let same = (1..dimension).all(|axis| shape[place + axis] == first);
                if same && MARKS.contains(&first) {
                    doubted.insert((specimen, point), first);
                }
            }
        }
        let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
        for (_, point) in doubted.keys() {
            *counts.entry(*point).or_default() += 1;
        }
        // A landmark that is at the origin in most specimens is what they were placed by.
        let all = shapes.ncols();
        let placed = |point: usize, mark: f64| {
            let count = counts.get(&point).copied().unwrap_or(0);
            count == all || mark == 0.0 && 2 * count >= all
        };
        doubted.retain(|&(_, point), mark| !placed(point, *mark));
        if doubted.is_empty() {
            return;
        }
        let absent: Vec<(usize, usize)> = self
            .missing
            .iter()
            .enumerate()
            .flat_map(|(specimen, missing)| missing.iter().map(move |gap| (specimen, gap.point)))
            .collect();
        let places: Vec<(usize, usize)> = doubted.keys().copied().collect();
        // What is looked at must be numbers, also where it is passed over.
        let numbers = shapes.map(|value| if value.is_finite() { value } else { 0.0 });
        let confirmed = look(dimension, &numbers, &absent, &places).confirmed;
        for (&(specimen, point), mark) in &doubted {
            let twice = doubted
                .iter()
                .filter(|&(&(other, _), of_other)| other == specimen && of_other == mark)
                .count()
                > 1;
            let usual = 2 * counts.get(&point).copied().unwrap_or(0) >= all;
            if twice || usual || confirmed.contains(&(specimen, point)) {
                let mark = vec![mark.to_string(); dimension].join(" ").replace('-', "−");
                let place = Some(format!("“{mark}”"));
                self.missing[specimen].push(MissingPoint { point, place });
            }
        }
        for missing in &mut self.missing {
            missing.sort_by_key(|gap| gap.point);
        }
    }

    fn missing_fault(&self, gone: &[(usize, usize)], points: usize) -> Fault {
        let mut by_specimen: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for &(specimen, point) in gone {
            by_specimen.entry(specimen).or_default().push(point);
        }
        let shown: Vec<String> = by_specimen
            .iter()
            .take(NAMED)
            .map(|(&specimen, points)| {
                let first = self.missing[specimen].iter().find(|gap| gap.point == points[0]);
                let place = first.and_then(|gap| gap.place.as_deref());
                let place = place.map(|place| format!(" ({place})")).unwrap_or_default();
                format!("{} of {}{place}", landmarks(points), self.called(specimen))
            })
            .collect();
        let more = by_specimen.len().saturating_sub(NAMED);
        let shown = if more > 0 {
            format!("{}, and more in {}", shown.join(", "), counted(more, "specimen", "specimens"))
        } else {
            listed(shown.iter().map(String::as_str))
        };
        let which = format!(
            "{} missing in {} of {} specimens: {shown}",
            counted(gone.len(), "landmark is", "landmarks are"),
            by_specimen.len(),
            self.left.len(),
        );
        let mut landmarks: Vec<usize> = gone.iter().map(|(_, point)| *point).collect();
        landmarks.sort_unstable();
        landmarks.dedup();
        let mut choices = Vec::new();
        if self.left.len() >= by_specimen.len() + 3 {
            let label =
                format!("Leave out {}", counted(by_specimen.len(), "specimen", "specimens"));
            choices.push(self.reading.choice(label, |to| to.missing = Some(Missing::Specimens)));
        }
        if points >= landmarks.len() + 3 {
            let label = format!(
                "Leave out {} of all specimens",
                counted(landmarks.len(), "landmark", "landmarks")
            );
            choices.push(self.reading.choice(label, |to| to.missing = Some(Missing::Points)));
        }
        let marks = gone.iter().all(|&(specimen, point)| {
            let gap = self.missing[specimen].iter().find(|gap| gap.point == point);
            gap.and_then(|gap| gap.place.as_deref()).is_some_and(|place| place.starts_with('“'))
        });
        if marks {
            let label = "They are coordinates";
            choices.push(self.reading.choice(label, |to| to.missing = Some(Missing::Values)));
        }
        Fault::Missing { which, choices }
    }

    /// That a first column was taken as the number of the point.
    pub(crate) fn first_column_finding(&self) -> Option<Finding> {
        let counts = self.numbered && self.reading.first_column.is_none();
        counts.then(|| {
            let message =
                "The first column counts the points: it was taken as their number, not as x.";
            let change = |to: &mut Reading| to.first_column = Some(FirstColumn::Coordinate);
            let choices = vec![self.reading.choice("Take it as x", change)];
            Finding::new("first-column", message, choices).sure()
        })
    }

    /// What is unusual about the specimens that are left.
    pub(crate) fn findings(&self, dimension: usize, shapes: &DMatrix<f64>) -> Vec<Finding> {
        let found = look(dimension, shapes, &[], &[]);
        let own = |column: usize| self.left[column];
        let all = |columns: &[usize]| columns.iter().map(|&column| own(column)).collect::<Vec<_>>();
        let mut findings = Vec::new();
        if !found.mirrored.is_empty() {
            let specimens = all(&found.mirrored);
            let keys: Vec<String> = specimens.iter().map(|&one| self.key(one)).collect();
            let message = format!(
                "{} {} the other specimens only when mirrored: a right side among left ones, or an image that was flipped.",
                self.list(&specimens),
                if specimens.len() == 1 { "fits" } else { "fit" },
            );
            let label = if specimens.len() == 1 { "Mirror it" } else { "Mirror them" };
            let mirror = self.reading.choice(label, |to| {
                for key in keys {
                    match to.mirror.iter().position(|name| *name == key) {
                        Some(place) => drop(to.mirror.remove(place)),
                        None => to.mirror.push(key),
                    }
                }
            });
            findings.push(Finding::new(
                "mirrored",
                message,
                vec![mirror, self.leave_out(&specimens)],
            ));
        }
        findings.extend(self.size_finding(&found.sizes));
        if !found.same.is_empty() {
            let pairs: Vec<String> = found
                .same
                .iter()
                .take(NAMED)
                .map(|&[one, other]| {
                    format!("{} and {}", self.called(own(one)), self.called(own(other)))
                })
                .collect();
            let message = format!(
                "The same shape is there twice: {}{}.",
                pairs.join("; "),
                if found.same.len() > NAMED { " and more" } else { "" }
            );
            let mut later: Vec<usize> = found.same.iter().map(|&[_, other]| own(other)).collect();
            later.sort_unstable();
            later.dedup();
            findings.push(Finding::new("duplicate", message, vec![self.leave_out(&later)]));
        }
        findings.extend(self.landmark_finding(&found.landmarks));
        if !found.exchanged.is_empty() {
            let each: Vec<String> = found
                .exchanged
                .iter()
                .take(NAMED)
                .map(|&(column, [one, other])| {
                    let points = [self.points_named(one), self.points_named(other)];
                    format!("{} and {} of {}", points[0], points[1], self.called(own(column)))
                })
                .collect();
            let message = format!("Landmarks seem to be exchanged: {}.", each.join("; "));
            let columns: Vec<usize> = found.exchanged.iter().map(|(column, _)| *column).collect();
            let choices = vec![self.leave_out(&all(&columns))];
            findings.push(Finding::new("exchanged-landmarks", message, choices));
        }
        findings.extend(self.order_finding(&found.reordered));
        if !found.far.is_empty() {
            let columns: Vec<usize> = found.far.iter().map(|(column, _)| *column).collect();
            let specimens = all(&columns);
            let times = found.far.iter().map(|(_, times)| *times).fold(0.0, f64::max);
            let message = format!(
                "{} {} up to {} times as far from the others as the middle specimen: another kind of shape, or points in another order.",
                self.list(&specimens),
                if specimens.len() == 1 { "lies" } else { "lie" },
                three_digits(times)
            );
            findings.push(Finding::new("outlier", message, vec![self.leave_out(&specimens)]));
        }
        if found.widest > WIDE {
            let message = format!(
                "The shapes vary much: the farthest lies {} radians (Procrustes distance) from the middle. A linear model treats the curved space of shapes as flat, which changes distances of this size by {} %.",
                three_digits(found.widest),
                three_digits(100.0 * (1.0 - libm::sin(found.widest) / found.widest)),
            );
            findings.push(Finding::new("wide-variation", message, Vec::new()).sure());
        }
        findings
    }

    /// Specimens whose points are in another order. Points that are left out change the numbers, so there is no remedy
    /// then but to leave the specimens out.
    fn order_finding(&self, found: &[(usize, PointOrder)]) -> Option<Finding> {
        if found.is_empty() {
            return None;
        }
        let each: Vec<String> = found
            .iter()
            .take(NAMED)
            .map(|&(column, order)| {
                let from = if order.backwards { "backwards from" } else { "from" };
                let first = self.points_named(order.first);
                format!("{} {from} point {first}", self.called(self.left[column]))
            })
            .collect();
        let more = if found.len() > NAMED { ", and more" } else { "" };
        let message = format!(
            "The points are in another order than those of the other specimens, which fit when they are counted so: {}{more}.",
            each.join(", ")
        );
        let specimens: Vec<usize> = found.iter().map(|(column, _)| self.left[*column]).collect();
        let mut choices = Vec::new();
        if self.reading.without_points.is_empty() && self.reading.missing != Some(Missing::Points) {
            let label = if found.len() == 1 { "Count them so" } else { "Count all of them so" };
            choices.push(self.reading.choice(label, |to| {
                for &(column, order) in found {
                    let list = if order.backwards { &mut to.reverse } else { &mut to.start };
                    list.push((self.key(self.left[column]), order.first + 1));
                }
            }));
        }
        choices.push(self.leave_out(&specimens));
        Some(Finding::new("point-order", message, choices))
    }

    fn size_finding(&self, sizes: &[(usize, f64)]) -> Option<Finding> {
        if sizes.is_empty() {
            return None;
        }
        /// Farther from a power of ten than this factor, and a unit does not explain it.
        const NEAR: f64 = 1.6;
        let specimens: Vec<usize> = sizes.iter().map(|&(column, _)| self.left[column]).collect();
        let each: Vec<String> = sizes
            .iter()
            .take(NAMED)
            .map(|&(column, ratio)| {
                let size = if ratio > 1.0 {
                    format!("{} times", three_digits(ratio))
                } else {
                    format!("1/{} of", three_digits(1.0 / ratio))
                };
                format!(
                    "{} has {size} the size of the middle specimen",
                    self.called(self.left[column])
                )
            })
            .collect();
        let more = if sizes.len() > NAMED { ", and more" } else { "" };
        let message = format!("{}{more}: it may be in another unit.", each.join(", "));
        let factors: Option<Vec<(String, f64)>> = sizes
            .iter()
            .map(|&(column, ratio)| {
                let power = libm::round(libm::log10(1.0 / ratio));
                let factor = libm::pow(10.0, power);
                let rest = factor * ratio;
                ((1.0 / NEAR..NEAR).contains(&rest) && power != 0.0)
                    .then(|| (self.key(self.left[column]), factor))
            })
            .collect();
        let mut choices = Vec::new();
        if let Some(factors) = factors {
            let label = match factors.as_slice() {
                [(_, factor)] => format!("Multiply it by {factor}"),
                _ => "Multiply them by powers of ten".to_owned(),
            };
            choices.push(self.reading.choice(label, |to| {
                for (key, factor) in factors {
                    to.rescale.retain(|(name, _)| *name != key);
                    to.rescale.push((key, factor));
                }
            }));
        }
        choices.push(self.leave_out(&specimens));
        Some(Finding::new("specimen-size", message, choices))
    }

    fn landmark_finding(&self, found: &[(usize, usize, f64)]) -> Option<Finding> {
        if found.is_empty() {
            return None;
        }
        let each: Vec<String> = found
            .iter()
            .take(NAMED)
            .map(|&(column, point, radii)| {
                format!(
                    "landmark {} of {} by {}",
                    self.points_named(point),
                    self.called(self.left[column]),
                    three_digits(radii)
                )
            })
            .collect();
        let more = if found.len() > NAMED { ", and more" } else { "" };
        let message = format!(
            "Landmarks lie elsewhere than in the other specimens, in units of the shape's radius (root mean square distance of its landmarks from their centre): {}{more}.",
            each.join(", ")
        );
        let mut specimens: Vec<usize> =
            found.iter().map(|(column, ..)| self.left[*column]).collect();
        specimens.dedup();
        let mut points: Vec<usize> =
            found.iter().map(|(_, point, _)| self.points[*point]).collect();
        points.sort_unstable();
        points.dedup();
        let label = format!("Leave out {} of all", landmarks(&points));
        let change = |to: &mut Reading| {
            to.without_points.extend(points.iter().map(|point| point + 1));
            to.without_points.sort_unstable();
            to.without_points.dedup();
        };
        let choices = vec![self.leave_out(&specimens), self.reading.choice(label, change)];
        Some(Finding::new("outlying-landmark", message, choices))
    }

    /// The number of a point that is left, from 1, as the files count.
    fn points_named(&self, point: usize) -> String {
        (self.points.get(point).copied().unwrap_or(point) + 1).to_string()
    }

    fn leave_out(&self, specimens: &[usize]) -> Choice {
        let label = match specimens {
            [one] => format!("Leave out {}", self.called(*one)),
            several => format!("Leave out {} specimens", several.len()),
        };
        self.reading.choice(label, |to| {
            to.without.extend(specimens.iter().map(|&specimen| self.key(specimen)));
        })
    }
}

/// "landmark 6", "landmarks 2 and 4": from 1.
fn landmarks(points: &[usize]) -> String {
    let numbers: Vec<String> = points.iter().map(|point| (point + 1).to_string()).collect();
    match numbers.as_slice() {
        [one] => format!("landmark {one}"),
        several => format!("landmarks {}", listed(several.iter().map(String::as_str))),
    }
}
