//! Builds a model from a population of shapes in correspondence: Procrustes alignment, then principal components.
//!
//! All shapes must have the same points in the same order, which is seen from their number and from
//! their faces. They are moved onto their mean by generalised Procrustes analysis (rotation and
//! translation; size too when asked for), and principal components with divisor N − 1 are the
//! model: at most N − 1 modes. Line meshes that all lie in planes of equal z are two-dimensional.
//!
//! The model lives in the frame of the first shape. Two populations must be aligned to each other
//! before they are compared.
//!
//! **Limits.** At least three shapes. Whether points of the same number correspond anatomically cannot be checked.
//!
//! **References.** Gower, "Generalized Procrustes analysis", Psychometrika 40 (1975); Dryden & Mardia,
//! "Statistical Shape Analysis", 2nd ed. (2016), chapter 7.

use crate::formats::error::{Fault, counted};
use nalgebra::{DMatrix, DMatrixView};

use crate::formats::input::sniffing::Content;
use crate::formats::input::{Input, compressed, paths};
use crate::formats::landmarks::{self, Landmarks, Specimen, order_by_name};
use crate::formats::mesh::stl::Welding;
use crate::formats::mesh::{self, Mesh, stl};
use crate::formats::readers::{cells, named_arrays};
use crate::formats::reading::{Finding, Reading};
use crate::formats::several::naming::name_of;
use crate::formats::several::specimens::{self, Specimens};
use crate::formats::several::table::{SideTable, SpecimenTable};
use crate::formats::{FormatError, Opened, Options, Origin, Part};
use crate::model::{
    Alignment, BasisCheck, Cells, ModelError, centroid_size, generalised_procrustes,
    model_of_population,
};
use crate::text::thousands;

/// Largest root mean square deviation from the mean, relative to the size of the shapes, that single
/// precision explains.
const ROUNDING: f64 = 3e-7;

/// Makes a model of shapes, one or several in each file.
pub(crate) fn read(inputs: &[Input], options: &Options) -> Result<Opened, FormatError> {
    let (files, tables) = with_tables_apart(inputs);
    let name = name_of(&files);
    let (files, local) = without_local(&files);
    let shapes = Shapes::of_files(&files, tables, &options.reading)?;
    let format = shapes.format();
    let part = shapes.into_part(&name, local).map_err(|fault| fault.of(&name))?;
    if let Some(wanted) = &options.part
        && *wanted != part.name
    {
        let parts = vec![part.name];
        return Err(Fault::NoPart { part: wanted.clone(), parts }.of(&name));
    }
    Ok(Opened { format, parts: vec![part.name.clone()], part })
}

/// Makes a model of the shapes in a file of arrays; `None` when they are none.
pub(crate) fn read_arrays(
    input: &Input,
    content: Content,
    options: &Options,
) -> Result<Option<Opened>, FormatError> {
    let reading = &options.reading;
    let refused = |fault: Fault| fault.of(&input.name);
    let wanted = options.part.as_deref();
    let found = named_arrays::read_shapes(input, content, wanted, reading).map_err(refused)?;
    let Some(set) = found else { return Ok(None) };
    let mut shapes = Shapes::new(reading);
    shapes.kinds.push(landmarks::kind(content));
    shapes.add_landmarks(input, set.landmarks)?;
    let format = shapes.format();
    let file = input.file_name();
    let name = if set.parts.len() > 1 { format!("{file}#{}", set.part) } else { file.to_owned() };
    let part = shapes.into_part(&name, 0).map_err(refused)?;
    Ok(Some(Opened { format, parts: set.parts, part: Part { name: set.part, ..part } }))
}

/// Shapes in correspondence, as they are in their files.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeSet {
    /// Coordinates per point.
    pub dimension: usize,
    /// Points of all shapes, one shape a column (d·n × N).
    pub shapes: DMatrix<f64>,
    /// What is unusual about them.
    pub findings: Vec<Finding>,
}

/// Reads the shapes of files or archives, one or several in each, without making a model of them. Files of
/// no known format beside shapes are left out, unless their names end as theirs do.
///
/// # Errors
/// [`FormatError`] of the first file that has none, or that does not correspond to the first.
pub fn read_shapes(inputs: &[Input], reading: &Reading) -> Result<ShapeSet, FormatError> {
    let (name, mut inputs, tables) = unpacked_with_tables(inputs)?;
    let contents: Vec<_> = inputs.iter().map(|input| compressed::content(input).ok()).collect();
    let shape_endings: Vec<String> = inputs
        .iter()
        .zip(&contents)
        .filter(|(_, content)| {
            content.is_some_and(|content| {
                landmarks::is_shape(content) || named_arrays::is_arrays(content)
            })
        })
        .map(|(input, _)| paths::ending(input.file_name()))
        .collect();
    if !shape_endings.is_empty() {
        let mut contents = contents.iter();
        inputs.retain(|input| {
            contents.next().is_some_and(Option::is_some)
                || shape_endings.contains(&paths::ending(input.file_name()))
        });
    }
    let shapes = Shapes::of_files(&without_local(&inputs).0, tables, reading)?;
    let refused = |fault: Fault| fault.of(&name);
    let population =
        shapes.into_population().map_err(refused)?.ok_or_else(|| refused(Fault::Empty))?;
    let Population { dimension, shapes, specimens, findings: of_files, .. } = population;
    let mut findings = specimens.findings(dimension, &shapes);
    findings.extend(of_files);
    Ok(ShapeSet { dimension, shapes, findings })
}

/// The table of the specimens of files or archives, of whatever columns their files or a table beside them have.
///
/// # Errors
/// [`FormatError`] of the first file that has none, or that does not correspond to the first.
pub fn read_specimens(inputs: &[Input], reading: &Reading) -> Result<SpecimenTable, FormatError> {
    let (name, files, tables) = unpacked_with_tables(inputs)?;
    let shapes = Shapes::of_files(&without_local(&files).0, tables, reading)?;
    shapes.into_table().map_err(|fault| fault.of(&name))
}

/// A table beside shapes, with the name of its file.
type NamedTable = (String, SideTable);

/// What files are called, those in them where they are archives, in order, and the tables beside them.
fn unpacked_with_tables(
    inputs: &[Input],
) -> Result<(String, Vec<Input>, Vec<NamedTable>), FormatError> {
    let (inputs, mut tables) = with_tables_apart(inputs);
    let mut files = Vec::new();
    for input in &inputs {
        files.extend(compressed::files_in(input)?);
    }
    let (files, within) = with_tables_apart(&paths::in_order(&files));
    tables.extend(within);
    Ok((name_of(&inputs), files, tables))
}

/// Shapes, and tables beside them that say more of each.
fn with_tables_apart(inputs: &[Input]) -> (Vec<Input>, Vec<NamedTable>) {
    let mut tables = Vec::new();
    let shapes = inputs
        .iter()
        .filter(|input| match side_table(input) {
            Some(table) => {
                tables.push((input.file_name().to_owned(), table));
                false
            }
            None => true,
        })
        .cloned()
        .collect();
    (shapes, tables)
}

/// The table in a file that is no shape.
pub(crate) fn side_table(input: &Input) -> Option<SideTable> {
    const LONGEST: u64 = 16 << 20;
    const ENDINGS: [&str; 4] = ["csv", "tsv", "txt", "dat"];
    let may_be = ENDINGS.contains(&paths::ending(input.file_name()).as_str());
    if !may_be || input.len() > LONGEST || compressed::content(input).is_ok() {
        return None;
    }
    SideTable::read(&input.bytes().ok()?)
}

/// ShapeWorks writes each shape twice: `_world` is aligned, `_local` as it was. Returns the aligned
/// ones where there are some, and how many were left out.
fn without_local(inputs: &[Input]) -> (Vec<&Input>, usize) {
    let ends = |input: &Input, end: &str| paths::stem(input.file_name()).ends_with(end);
    if !inputs.iter().any(|input| ends(input, "_world")) {
        return (inputs.iter().collect(), 0);
    }
    let kept: Vec<&Input> = inputs.iter().filter(|input| !ends(input, "_local")).collect();
    let left_out = inputs.len() - kept.len();
    (kept, left_out)
}

/// Shapes in correspondence with the first of them.
#[derive(Debug, Default)]
pub(crate) struct Shapes {
    first: Option<First>,
    /// Points of all shapes, one after the other.
    values: Vec<f64>,
    count: usize,
    /// What the shapes are called, of each file.
    kinds: Vec<&'static str>,
    /// Names of the landmarks of the first file that has some, and its name.
    landmarks: Option<(String, Vec<String>)>,
    scales: Vec<Option<f64>>,
    notes: Vec<String>,
    /// How files were read that leave it open.
    findings: Vec<Finding>,
    /// What each shape is called, and which of its points are missing.
    specimens: Specimens,
}

/// Shapes that are read, without those that the reading leaves out.
pub(crate) struct Population {
    /// Coordinates per point.
    pub(crate) dimension: usize,
    /// One shape a column (d·n × N).
    pub(crate) shapes: DMatrix<f64>,
    /// Cells of the points that are left.
    pub(crate) cells: Cells,
    /// Notes for the user.
    pub(crate) notes: Vec<String>,
    /// How files were read that leave it open.
    pub(crate) findings: Vec<Finding>,
    /// Names of the specimens that are left.
    pub(crate) specimens: Specimens,
}

/// What all further shapes must agree with.
#[derive(Debug)]
struct First {
    name: String,
    dimension: usize,
    points: usize,
    cells: Cells,
    welding: Option<Welding>,
}

impl Shapes {
    /// No shapes yet, to be read in this way.
    pub(crate) fn new(reading: &Reading) -> Self {
        Self { specimens: Specimens::new(reading), ..Self::default() }
    }

    /// The shapes of files, with what tables beside them say of each.
    fn of_files(
        files: &[&Input],
        tables: Vec<NamedTable>,
        reading: &Reading,
    ) -> Result<Self, FormatError> {
        let mut shapes = Self::new(reading);
        for file in files {
            shapes.add_file(file)?;
        }
        for (name, table) in tables {
            shapes.notes.push(shapes.specimens.join(&name, &table));
        }
        Ok(shapes)
    }

    /// Number of shapes.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// "PLY meshes", "TPS landmarks".
    pub(crate) fn format(&self) -> String {
        let mut names = self.kinds.clone();
        names.sort_unstable();
        names.dedup();
        names.join(" and ")
    }

    /// Adds the shape of a file, or all of its shapes.
    pub(crate) fn add_file(&mut self, input: &Input) -> Result<(), FormatError> {
        let input = compressed::unpacked(input)?;
        let (content, bytes) = crate::formats::input::sniffing::read(&input)?;
        let refused = |fault: Fault| fault.of(&input.name);
        self.kinds.push(kind_of(content));
        match content {
            Content::Stl => {
                let corners = stl::corners(&bytes).map_err(refused)?;
                self.add_corners(&input.name, input.file_name(), &corners)
            }
            content if landmarks::is_landmarks(content) => {
                let landmarks =
                    landmarks::read(content, &bytes, self.specimens.reading()).map_err(refused)?;
                self.add_landmarks(&input, landmarks)
            }
            content if named_arrays::is_arrays(content) => {
                let reading = self.specimens.reading();
                let found = named_arrays::read_shapes(&input, content, None, reading);
                match found.map_err(refused)? {
                    Some(set) => self.add_landmarks(&input, set.landmarks),
                    None => Err(refused(Fault::NoShape { format: content.name() })),
                }
            }
            content if !landmarks::is_shape(content) => {
                Err(refused(Fault::NoShape { format: content.name() }))
            }
            content => {
                let mesh = mesh::read(content, &bytes).map_err(refused)?;
                self.add(&input.name, Some(input.file_name()), &mut Specimen::new(mesh))
            }
        }
    }

    /// Puts the landmarks of a file into the order of the first, where both have the same names.
    fn match_names(&mut self, file: &str, landmarks: &mut Landmarks) {
        if landmarks.point_names.is_empty() {
            return;
        }
        let Some((first, names)) = &self.landmarks else {
            self.landmarks = Some((file.to_owned(), core::mem::take(&mut landmarks.point_names)));
            return;
        };
        let note = match order_by_name(names, &landmarks.point_names) {
            Some(order) => {
                for specimen in &mut landmarks.specimens {
                    specimen.mesh.reorder(&order);
                }
                format!("Landmarks in another order than in {first} were matched by their names.")
            }
            None if *names != landmarks.point_names => format!(
                "Landmarks have other names than in {first}, or names that occur twice: they were matched by their order."
            ),
            None => return,
        };
        self.note(note);
    }

    /// A note, once.
    fn note(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Adds the specimens of a file.
    fn add_landmarks(
        &mut self,
        input: &Input,
        mut landmarks: Landmarks,
    ) -> Result<(), FormatError> {
        if let (Some(kind), Some(last)) = (landmarks.kind, self.kinds.last_mut()) {
            *last = kind;
        }
        self.match_names(&input.name, &mut landmarks);
        for note in landmarks.notes {
            self.note(note);
        }
        self.findings.extend(landmarks.findings);
        let specimens = landmarks.specimens;
        let several = specimens.len() > 1;
        for (index, mut specimen) in specimens.into_iter().enumerate() {
            let name = if several {
                format!("{}, specimen {}", input.name, index + 1)
            } else {
                input.name.clone()
            };
            self.scales.push(specimen.scale);
            let file = (!several).then(|| input.file_name());
            self.add(&name, file, &mut specimen)?;
        }
        Ok(())
    }

    fn add_corners(
        &mut self,
        name: &str,
        file: &str,
        corners: &[[f64; 3]],
    ) -> Result<(), FormatError> {
        if self.first.is_none() {
            let welding = Welding::of(corners);
            let mesh = welding.mesh(corners).map_err(|fault| fault.of(name))?;
            self.notes.push(
                "STL files have no point numbers: corners that are equal in the first of them are one \
                 point in all."
                    .to_owned(),
            );
            self.add(name, Some(file), &mut Specimen::new(mesh))?;
            if let Some(first) = &mut self.first {
                first.welding = Some(welding);
            }
            return Ok(());
        }
        let own;
        let welding = match self.first.as_ref().and_then(|first| first.welding.as_ref()) {
            Some(welding) => welding,
            None => {
                own = Welding::of(corners);
                &own
            }
        };
        let first = self.first.as_ref().map(|first| first.name.as_str()).unwrap_or_default();
        if corners.len() != welding.corner_count() {
            let difference = format!(
                "It has {} faces, {first} has {}",
                thousands(corners.len() / 3),
                thousands(welding.corner_count() / 3)
            );
            return Err(Fault::Correspondence { difference }.of(name));
        }
        if let Some([one, other]) = welding.disagreement(corners) {
            let difference = format!(
                "A corner of face {} and one of face {} are one point in {first}, but lie apart here",
                thousands(one / 3 + 1),
                thousands(other / 3 + 1)
            );
            return Err(Fault::Apart { difference }.of(name));
        }
        let mesh = welding.mesh(corners).map_err(|fault| fault.of(name))?;
        self.add(name, Some(file), &mut Specimen::new(mesh))
    }

    /// Adds a shape, if it corresponds to the first; `file` is the name of the file that it has to itself.
    fn add(
        &mut self,
        name: &str,
        file: Option<&str>,
        specimen: &mut Specimen,
    ) -> Result<(), FormatError> {
        let mesh = &mut specimen.mesh;
        match &self.first {
            None => {
                self.notes.extend(mesh.notes.iter().cloned());
                self.first = Some(First {
                    name: name.to_owned(),
                    dimension: mesh.dimension,
                    points: mesh.point_count(),
                    cells: core::mem::replace(&mut mesh.cells, Cells::None),
                    welding: None,
                });
            }
            Some(first) => {
                if let Some(difference) = difference(first, mesh) {
                    return Err(Fault::Correspondence { difference }.of(name));
                }
            }
        }
        let claimed = (self.values.len() + mesh.points.len()) as u64 * 8;
        let full = |_| {
            Fault::Size { what: "The set of shapes".to_owned(), claimed, limit: claimed / 2 }
                .of(name)
        };
        self.values.try_reserve(mesh.points.len()).map_err(full)?;
        self.values.extend_from_slice(&mesh.points);
        self.count += 1;
        self.specimens.add(file, specimen);
        Ok(())
    }

    /// The table of all specimens, whatever the reading leaves out.
    fn into_table(mut self) -> Result<SpecimenTable, Fault> {
        let Some((dimension, shapes, _)) = self.as_read() else { return Err(Fault::Empty) };
        // Those that it keeps, where it can be carried out.
        let _ = self.specimens.choose(dimension, shapes.clone(), Cells::None);
        Ok(self.specimens.table(dimension, &shapes))
    }

    /// The shapes as they are in their files, but for SCALE and a third coordinate that says nothing, with their dimension
    /// and cells; numbers that mark missing landmarks are found on the way.
    fn as_read(&mut self) -> Option<(usize, DMatrix<f64>, Cells)> {
        let First { mut dimension, points, cells, .. } = self.first.take()?;
        let length = dimension * points;
        let mut values = core::mem::take(&mut self.values);
        // As the file has them: a mark times SCALE is none.
        self.specimens.find_marks(dimension, DMatrixView::from_slice(&values, length, self.count));
        if !self.scales.is_empty() && self.scales.iter().all(Option::is_some) {
            for (shape, scale) in values.chunks_exact_mut(length).zip(&self.scales) {
                shape.iter_mut().for_each(|value| *value *= scale.unwrap_or(1.0));
            }
            self.notes
                .push("The landmarks were multiplied by the SCALE of each specimen.".to_owned());
        } else if self.scales.iter().any(Option::is_some) {
            let note = "Only some specimens have a SCALE, so none was used.";
            self.notes.push(note.to_owned());
        }
        let is_line = matches!(cells, Cells::Segments(_));
        let is_flat = |shape: &[f64]| shape.iter().skip(2).step_by(3).all(|z| *z == shape[2]);
        if dimension == 3 && is_line && values.chunks_exact(length).all(is_flat) {
            dimension = 2;
            let mut place = 0;
            values.retain(|_| {
                place += 1;
                place % 3 != 0
            });
            let note = "All points of a contour have the same z: it was taken as two-dimensional.";
            self.notes.push(note.to_owned());
        }
        Some((dimension, DMatrix::from_vec(dimension * points, self.count, values), cells))
    }

    /// The shapes as the reading wants them; `None` when there are none.
    pub(crate) fn into_population(mut self) -> Result<Option<Population>, Fault> {
        let Some((dimension, shapes, cells)) = self.as_read() else { return Ok(None) };
        let specimens::Chosen { shapes, cells, notes } =
            self.specimens.choose(dimension, shapes, cells)?;
        self.notes.extend(notes);
        let (notes, findings, specimens) = (self.notes, self.findings, self.specimens);
        Ok(Some(Population { dimension, shapes, cells, notes, findings, specimens }))
    }

    fn into_part(self, name: &str, local: usize) -> Result<Part, Fault> {
        let scaled = self.specimens.reading().scale;
        let Some(population) = self.into_population()? else { return Err(Fault::Empty) };
        let Population {
            dimension,
            mut shapes,
            cells: mut drawn,
            notes: file_notes,
            findings: of_files,
            specimens,
        } = population;
        let read = shapes.ncols();
        if read < 3 {
            return Err(Fault::Model(ModelError::TooFewShapes { found: read }));
        }
        let sizes: Vec<f64> =
            shapes.column_iter().map(|shape| centroid_size(shape.as_slice(), dimension)).collect();
        let mut findings = specimens.findings(dimension, &shapes);
        let alignment = if scaled { Alignment::Similarity } else { Alignment::Rigid };
        let mean = generalised_procrustes(dimension, &mut shapes, alignment);
        if mean.iter().any(|value| !value.is_finite()) || varies_by(&shapes, dimension) <= ROUNDING
        {
            return Err(Fault::SameShapes { count: read });
        }
        let adjusted = specimens.adjust(&mut shapes, &sizes)?;
        let mut name = name.to_owned();
        let mut together = String::new();
        if let Some((group, places)) = specimens.group()? {
            name = format!("{}, {name}", group.label());
            together =
                format!(", superimposed together with all {} that were read", thousands(read));
            shapes = shapes.select_columns(&places);
        }
        let count = shapes.ncols();
        if count < 3 {
            return Err(Fault::Model(ModelError::TooFewShapes { found: count }));
        }
        let model = model_of_population(dimension, shapes, alignment).map_err(Fault::Model)?;
        let mut notes = vec![format!(
            "Made of {count} shapes{together}, moved and turned onto their mean {}: {}.",
            if scaled { "and brought to one size" } else { "without changing their size" },
            counted(model.mode_count(), "mode", "modes"),
        )];
        notes.extend(adjusted);
        if local > 0 {
            let files = counted(local, "file", "files");
            notes.push(format!("{files} of unaligned points (`_local`) were left out."));
        }
        notes.extend(file_notes);
        notes.extend(cells::turn_outwards(&mut drawn, model.mean().as_slice(), dimension));
        let model = model.with_cells(drawn).map_err(Fault::Model)?.with_name(&name);
        findings.extend(specimens.first_column_finding());
        findings.extend(specimens.columns_finding());
        findings.extend(of_files);
        Ok(Part {
            name: "shape".to_owned(),
            model,
            check: BasisCheck { orthogonality_error: 0.0, dropped_modes: 0 },
            origin: Origin::Shapes { count, scaled },
            map: None,
            notes,
            findings,
        })
    }
}

/// What shapes of this content are called, several of them.
fn kind_of(content: Content) -> &'static str {
    match content {
        Content::Ply => "PLY meshes",
        Content::Obj => "OBJ meshes",
        Content::Off => "OFF meshes",
        Content::Stl => "STL meshes",
        Content::Vtk | Content::Vtp => "VTK meshes",
        content => landmarks::kind(content),
    }
}

/// Root mean square deviation from the mean shape, relative to its size.
fn varies_by(shapes: &DMatrix<f64>, dimension: usize) -> f64 {
    let mean = shapes.column_mean();
    let points = (mean.len() / dimension) as f64;
    let mut size = 0.0;
    for axis in 0..dimension {
        let along = || mean.iter().skip(axis).step_by(dimension);
        let centre = along().sum::<f64>() / points;
        size += along().map(|value| (value - centre) * (value - centre)).sum::<f64>();
    }
    let spread: f64 = shapes.column_iter().map(|shape| (shape - &mean).norm_squared()).sum();
    let spread = spread / shapes.ncols() as f64;
    if size > 0.0 { (spread / size).sqrt() } else { 0.0 }
}

/// How `mesh` differs from the first shape; `None` when it may correspond to it.
fn difference(first: &First, mesh: &Mesh) -> Option<String> {
    let name = &first.name;
    if mesh.dimension != first.dimension {
        return Some(format!(
            "Its points have {} coordinates, those of {name} {}",
            mesh.dimension, first.dimension
        ));
    }
    if mesh.point_count() != first.points {
        return Some(format!(
            "It has {}, {name} has {}",
            points(mesh.point_count()),
            thousands(first.points)
        ));
    }
    if same_cells(&mesh.cells, &first.cells) {
        return None;
    }
    let (found, expected) = (cell_count(&mesh.cells), cell_count(&first.cells));
    Some(if found == expected {
        format!("Its faces join other points than those of {name}")
    } else {
        format!("It has {} faces, {name} has {}", thousands(found), thousands(expected))
    })
}

fn cell_count(cells: &Cells) -> usize {
    match cells {
        Cells::None => 0,
        Cells::Segments(segments) => segments.len(),
        Cells::Triangles(triangles) => triangles.len(),
    }
}

/// Whether the same points are joined, in whatever order.
fn same_cells(a: &Cells, b: &Cells) -> bool {
    fn sorted<const K: usize>(cells: &[[u32; K]]) -> Vec<[u32; K]> {
        let mut cells = cells.to_vec();
        cells.iter_mut().for_each(|cell| cell.sort_unstable());
        cells.sort_unstable();
        cells
    }
    a == b
        || match (a, b) {
            (Cells::Segments(a), Cells::Segments(b)) => sorted(a) == sorted(b),
            (Cells::Triangles(a), Cells::Triangles(b)) => sorted(a) == sorted(b),
            _ => false,
        }
}

/// "1 point", "4,388 points".
fn points(count: usize) -> String {
    format!("{} {}", thousands(count), if count == 1 { "point" } else { "points" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_in_another_order_or_wound_the_other_way_are_the_same() {
        let faces = |rows: &[[u32; 3]]| Cells::Triangles(rows.to_vec());
        let whole = faces(&[[0, 1, 2], [0, 2, 3]]);
        assert!(same_cells(&whole, &faces(&[[3, 2, 0], [1, 2, 0]])), "the same");
        assert!(!same_cells(&whole, &faces(&[[0, 1, 3], [1, 2, 3]])), "the other diagonal");
        assert!(!same_cells(&whole, &Cells::None), "no faces");
    }
}
