//! Recognises models by the names of their arrays, in any container: NumPy archives and dictionaries, MATLAB files,
//! Python pickles, HDF5 trees.
//!
//! A container gives [`NamedArrays`]: names, the shapes of their arrays, and the arrays, read when they are asked for.
//! A field in a group is a dotted name, `shp.mu`. Three steps recognise a model, first at the top, then in groups:
//!
//! **Known layouts**, told by names that belong together. λ are variances, σ standard deviations.
//!
//! | layout | mean | modes | length of the modes | faces | unit |
//! |---|---|---|---|---|---|
//! | BFM 2009 | `shapeMU` | `shapePC` | 1, σ in `shapeEV` | `tl`, from 1, reversed | µm |
//! | | `texMU`, 0…255 | `texPC` | 1, σ in `texEV` | | |
//! | Deep3D (MATLAB) | `meanshape` | `idBase`, `exBase` | σ | `tri`, from 1 | dm |
//! | FaceVerse | `meanshape` | `idBase`, `exBase` | σ | `tri` | |
//! | | `meantex`, 0…255 | `texBase` | σ | | |
//! | LYHM | `shp.mu` | `shp.eigVec` | 1, λ in `shp.eigVal` | `tri.faces`, from 1, reversed | |
//! | | `tex.mu` | `tex.eigVec` | 1, λ in `tex.eigVal` | | |
//! | LSFM | `mean` | `components` | 1, λ in `eigenvalues` | `trilist` | |
//! | 3DDFA | `u` or `u_shp` + `u_exp` | `w_shp`, `w_exp` | σ | `tri` | |
//! | GNM | `template_vertex_positions` | `vertex_identity_basis`, `expression_basis` (q × n × d) | σ | `triangles` | |
//! | gias3 | `mean` | `modes`, rows times `SD` | 1, λ in `weights` | | mm |
//!
//! **Body models**: `v_template` and `shapedirs` (n × 3 × q, columns of length σ), faces `f`, metres. The
//! number of joints, else that of points, tells FLAME (5), MANO (16), SMPL and STAR (24), SMPL+H (52) and
//! SMPL-X (55). In FLAME and SMPL-X the first modes are identity and the others expression: 300 of 400, 10
//! of 20. Expressions are displacements of the template.
//!
//! **Synonyms**, for everything else:
//!
//! | what | names |
//! |---|---|
//! | mean | `mean`, `mu`, `MU`, `meanshape`, `v_template`, `center` … (n × d, d × n or flat) |
//! | basis | `basis`, `components`, `modes`, `shapedirs`, `coeff`, `rotation` … (D × q, q × D, n × d × q, q × n × d) |
//! | variances λ | `eigenvalues`, `explained_variance`, `weights`, `latent` … |
//! | standard deviations | `std`, `sigma`, `sd`, `shapeEV`, `sdev` |
//! | faces | `faces`, `f`, `tri`, `triangles`, `cells` … |
//!
//! With variances the basis is taken as orthonormal, as its norms confirm or correct. Without them,
//! modes of length 1 get the standard deviation 1, others are already scaled. Singular values are
//! refused: they differ from standard deviations by √(N − 1), unless N is in the file (`n_samples_` of scikit-learn).
//!
//! A basis of integers (q × D) beside `basis_scale` (q) is our compact form: column i of the scaled
//! basis is `basis[i]`·`basis_scale[i]`. `SD` scales the rows of `modes`.
//!
//! **Training shapes**: `training_coefficients` (q × N, lengths along the unit modes, times `training_scale` (q) where
//! that is there), `projectedWeights` of gias3, `score` of MATLAB's `pca` and `x` of R's `prcomp` (N × q); what they are is seen from their variances (`scores`).
//!
//! **Limits.** Bilinear models (FaceScape's `shape_bm_core`) are refused. Body models are read in their
//! rest pose. Colours in 0…255 are divided by 255.
//!
//! **References.** Paysan et al., "A 3D face model for pose and illumination invariant face
//! recognition", AVSS 2009; Booth et al., "Large scale 3D morphable models", IJCV 2018; Dai et al.,
//! "Statistical modeling of craniofacial shape and texture", IJCV 2020; Loper et al., "SMPL", TOG 2015;
//! Li et al., "Learning a model of facial shape and expression from 4D scans", TOG 2017; Pavlakos et
//! al., "Expressive body capture", CVPR 2019.

use nalgebra::DVector;

use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::{Array, Data};
use crate::formats::error::{Fault, counted, not_numbers, shape_text};
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble, mesh_of};
use crate::formats::readers::cells::Habit;
use crate::formats::readers::parts::choose;
use crate::formats::readers::scores::Scores;
use crate::formats::readers::shape_arrays::axes_of;
use crate::formats::reading::Reading;
use crate::formats::{Opened, Options, Origin, Part};
use crate::model::{Cells, Kind, Unit};

/// Names listed when there is no model.
const MOST_NAMES: usize = 20;

/// Groups in which models are looked for.
const MOST_GROUPS: usize = 100;

/// Groups inside one another in which models are looked for.
const DEEPEST_GROUP: usize = 8;

/// How a model is to be made of the arrays of one layout.
#[derive(Debug, Clone)]
struct Layout {
    /// Before all names: "" or "group.".
    prefix: String,
    /// What it is called; empty for arrays under general names.
    name: &'static str,
    unit: Unit,
    /// Names of the faces; the first that is there counts.
    faces: &'static [&'static str],
    counting: Counting,
    /// For every point its number in a larger mesh.
    map: Option<&'static str>,
    parts: Vec<Recipe>,
    notes: Vec<String>,
}

/// How a format numbers and winds its faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Counting {
    /// Not specified: decided by the numbers.
    Open,
    /// Points count from 1.
    FromOne,
    /// Points count from 1, and faces are wound clockwise.
    FromOneReversed,
}

/// Which arrays make one part.
#[derive(Debug, Clone, Copy)]
struct Recipe {
    part: &'static str,
    /// Arrays whose sum is the mean.
    mean: &'static [&'static str],
    basis: &'static str,
    scale: Scale,
    /// The modes wanted, of all in the basis; `None` for all.
    modes: Option<(usize, usize)>,
}

/// What is known of the length of the modes.
#[derive(Debug, Clone, Copy)]
enum Scale {
    /// 1, with variances under this name.
    Variances(&'static str),
    /// 1, with standard deviations under this name.
    Deviations(&'static str),
    /// The standard deviation.
    Already,
    /// What the general names beside it tell.
    Open,
}

impl Recipe {
    const fn new(
        part: &'static str,
        mean: &'static [&'static str],
        basis: &'static str,
        scale: Scale,
    ) -> Self {
        Self { part, mean, basis, scale, modes: None }
    }

    fn is_color(&self) -> bool {
        self.part == "color"
    }
}

/// A layout that is recognised by its names.
struct Known {
    name: &'static str,
    /// The only container in which these names mean it; empty for any.
    container: &'static str,
    /// Names that must be there.
    needs: &'static [&'static str],
    unit: Unit,
    faces: &'static [&'static str],
    counting: Counting,
    map: Option<&'static str>,
    /// Those whose basis is there are in the file.
    parts: &'static [Recipe],
}

const DEEP3D: &[Recipe] = &[
    Recipe::new("shape", &["meanshape"], "idBase", Scale::Already),
    Recipe::new("expression", &["meanshape"], "exBase", Scale::Already),
    Recipe::new("color", &["meantex"], "texBase", Scale::Already),
];

const KNOWN: &[Known] = &[
    Known {
        name: "BFM 2009",
        container: "",
        needs: &["shapeMU", "shapePC", "shapeEV"],
        unit: Unit::Micrometre,
        faces: &["tl"],
        counting: Counting::FromOneReversed,
        map: None,
        parts: &[
            Recipe::new("shape", &["shapeMU"], "shapePC", Scale::Deviations("shapeEV")),
            Recipe::new("color", &["texMU"], "texPC", Scale::Deviations("texEV")),
        ],
    },
    Known {
        name: "Deep3D",
        container: "MATLAB file",
        needs: &["meanshape", "idBase", "exBase"],
        unit: Unit::Decimetre,
        faces: &["tri"],
        counting: Counting::FromOne,
        map: None,
        parts: DEEP3D,
    },
    Known {
        name: "FaceVerse",
        container: "",
        needs: &["meanshape", "idBase", "exBase"],
        unit: Unit::Unknown,
        faces: &["tri"],
        counting: Counting::Open,
        map: None,
        parts: DEEP3D,
    },
    Known {
        name: "LYHM",
        container: "",
        needs: &["shp.mu", "shp.eigVec", "shp.eigVal"],
        unit: Unit::Unknown,
        faces: &["tri.faces", "tri"],
        counting: Counting::FromOneReversed,
        map: None,
        parts: &[
            Recipe::new("shape", &["shp.mu"], "shp.eigVec", Scale::Variances("shp.eigVal")),
            Recipe::new("color", &["tex.mu"], "tex.eigVec", Scale::Variances("tex.eigVal")),
        ],
    },
    Known {
        name: "LSFM",
        container: "",
        needs: &["mean", "components", "eigenvalues", "trilist"],
        unit: Unit::Unknown,
        faces: &["trilist"],
        counting: Counting::Open,
        map: Some("map_cropped_to_full"),
        parts: &[Recipe::new("shape", &["mean"], "components", Scale::Variances("eigenvalues"))],
    },
    Known {
        name: "3DDFA",
        container: "",
        needs: &["u", "w_shp", "w_exp"],
        unit: Unit::Unknown,
        faces: &["tri"],
        counting: Counting::Open,
        map: None,
        parts: &[
            Recipe::new("shape", &["u"], "w_shp", Scale::Already),
            Recipe::new("expression", &["u"], "w_exp", Scale::Already),
        ],
    },
    Known {
        name: "3DDFA",
        container: "",
        needs: &["u_shp", "u_exp", "w_shp", "w_exp"],
        unit: Unit::Unknown,
        faces: &["tri"],
        counting: Counting::Open,
        map: None,
        parts: &[
            Recipe::new("shape", &["u_shp", "u_exp"], "w_shp", Scale::Already),
            Recipe::new("expression", &["u_shp", "u_exp"], "w_exp", Scale::Already),
        ],
    },
    Known {
        name: "GNM",
        container: "",
        needs: &["template_vertex_positions", "vertex_identity_basis", "expression_basis"],
        unit: Unit::Unknown,
        faces: &["triangles"],
        counting: Counting::Open,
        map: None,
        parts: &[
            Recipe::new(
                "shape",
                &["template_vertex_positions"],
                "vertex_identity_basis",
                Scale::Already,
            ),
            Recipe::new(
                "expression",
                &["template_vertex_positions"],
                "expression_basis",
                Scale::Already,
            ),
        ],
    },
    Known {
        name: "gias3",
        container: "",
        needs: &["mean", "modes", "weights", "projectedWeights"],
        unit: Unit::Millimetre,
        faces: &[],
        counting: Counting::Open,
        map: None,
        parts: &[Recipe::new("shape", &["mean"], "modes", Scale::Variances("weights"))],
    },
];

const MEANS: &[&str] = &[
    "mean",
    "mu",
    "meanshape",
    "mean_shape",
    "meanShape",
    "v_template",
    "shapeMU",
    "mean_vertices",
    "template_vertex_positions",
    "mean_",
    "MU",
    "center",
];
const BASES: &[&str] = &[
    "basis",
    "pcs",
    "components",
    "modes",
    "pcaBasis",
    "shapedirs",
    "eigVec",
    "shapePC",
    "idBase",
    "U",
    "vertex_identity_basis",
    "components_",
    "coeff",
    "COEFF",
    "eigenvectors",
    "rotation",
];
const VARIANCES: &[&str] = &[
    "eigenvalues",
    "variance",
    "variances",
    "explained_variance",
    "explained_variance_",
    "pcaVariance",
    "weights",
    "eigVal",
    "latent",
    "LATENT",
];
const DEVIATIONS: &[&str] = &["std", "sigma", "sd", "standard_deviations", "shapeEV", "sdev"];
/// Coefficients of the training shapes with a row for each shape: MATLAB's `pca`, R's `prcomp`.
const SCORES_BY_SHAPE: &[&str] = &["score", "x"];
const FACES: &[&str] = &["faces", "f", "tri", "triangles", "cells", "trilist", "tl"];

/// Reads one model of a table: the part wanted, or the first that can be read.
pub(crate) fn read(
    table: &mut dyn NamedArrays,
    file: &str,
    options: &Options,
) -> Result<Opened, Fault> {
    let layouts = layouts(table)?;
    let mut places = Vec::new();
    for layout in &layouts {
        for recipe in &layout.parts {
            let group = layout.prefix.trim_end_matches('.').rsplit('.').next().unwrap_or_default();
            let name = match (layouts.len(), recipe.part) {
                (1, part) => part.to_owned(),
                (_, "shape") => group.to_owned(),
                (_, part) => format!("{group} {part}"),
            };
            places.push((name, layout, recipe));
        }
    }
    let parts: Vec<String> = places.iter().map(|(name, ..)| name.clone()).collect();
    if places.is_empty() && options.part.is_none() {
        return Err(no_model(table));
    }
    let ((index, mut part, own_name), left_out) =
        choose(&parts, options.part.as_deref(), |index| {
            let (_, layout, recipe) = &places[index];
            read_part(table, layout, recipe, &options.reading)
                .map(|(part, own_name)| (index, part, own_name))
        })?;
    let (name, layout, _) = &places[index];
    part.name.clone_from(name);
    part.model = part.model.with_name(match own_name {
        Some(own) => own,
        None if parts.len() > 1 => format!("{file}#{name}"),
        None => file.to_owned(),
    });
    let is_said = part.notes.iter().any(|note| note.contains("cut off"));
    part.notes.extend(table.damage().filter(|_| !is_said).map(|fault| fault.to_string()));
    part.notes.extend(left_out);
    let container = table.container();
    let format = match layout.name {
        "" => container.to_owned(),
        known => format!("{known} ({container})"),
    };
    Ok(Opened { format, parts, part })
}

/// The models of a table: at its top, else in its groups, those nearest to the top.
fn layouts(table: &mut dyn NamedArrays) -> Result<Vec<Layout>, Fault> {
    if let Some(layout) = layout_in(table, "")? {
        return Ok(vec![layout]);
    }
    let mut groups: Vec<(usize, String)> = Vec::new();
    for name in table.names() {
        for (place, _) in name.match_indices('.').take(DEEPEST_GROUP) {
            let prefix = &name[..=place];
            // Names are in order, and so are the groups.
            if groups.last().is_none_or(|(_, last)| !last.starts_with(prefix)) {
                groups.push((prefix.matches('.').count(), prefix.to_owned()));
            }
        }
    }
    groups.sort();
    groups.dedup();
    groups.truncate(MOST_GROUPS);
    let mut found: Vec<Layout> = Vec::new();
    let mut depth = 0;
    for (level, prefix) in groups {
        if level > depth && !found.is_empty() {
            break;
        }
        depth = level;
        found.extend(layout_in(table, &prefix)?);
    }
    if found.is_empty() { Err(no_model(table)) } else { Ok(found) }
}

/// The model whose arrays have names that start with `prefix`.
fn layout_in(table: &mut dyn NamedArrays, prefix: &str) -> Result<Option<Layout>, Fault> {
    let has = |name: &str| table.shape(&format!("{prefix}{name}")).is_some();
    if has("shape_bm_core") {
        return Err(Fault::Bilinear { what: format!("{prefix}shape_bm_core") });
    }
    let known = KNOWN.iter().find(|known| {
        (known.container.is_empty() || known.container == table.container())
            && known.needs.iter().all(|name| has(name))
    });
    if let Some(known) = known {
        let is_there =
            |recipe: &&Recipe| has(recipe.basis) && recipe.mean.iter().all(|name| has(name));
        return Ok(Some(Layout {
            prefix: prefix.to_owned(),
            name: known.name,
            unit: known.unit,
            faces: known.faces,
            counting: known.counting,
            map: known.map,
            parts: known.parts.iter().filter(is_there).copied().collect(),
            notes: Vec::new(),
        }));
    }
    if let Some(body) = body_model(table, prefix) {
        return Ok(Some(body));
    }
    let general = |names: &'static [&'static str]| {
        let readable =
            |name: &str| table.shape(&format!("{prefix}{name}")).is_some_and(|shape| shape.is_ok());
        let place = names.iter().position(|name| readable(name));
        place.or_else(|| names.iter().position(|name| has(name)))
    };
    let (Some(mean), Some(basis)) = (general(MEANS), general(BASES)) else { return Ok(None) };
    let recipe = Recipe::new("shape", &MEANS[mean..=mean], BASES[basis], Scale::Open);
    let holds_no_numbers = |name: &String| {
        name.starts_with(prefix)
            && matches!(
                table.shape(name),
                Some(Err(Fault::NotNumbers { .. } | Fault::PickleClass { .. }))
            )
    };
    let notes = table
        .names()
        .into_iter()
        // The state of scikit-learn's generator is not missed.
        .filter(|name| holds_no_numbers(name) && !name.ends_with("random_state"))
        .take(MOST_NAMES)
        .map(|name| format!("The array {name} holds no numbers and was skipped."))
        .collect();
    Ok(Some(Layout {
        prefix: prefix.to_owned(),
        name: "",
        unit: Unit::Unknown,
        faces: FACES,
        counting: Counting::Open,
        map: None,
        parts: vec![recipe],
        notes,
    }))
}

/// A model of SMPL's family, where joints or points say which.
fn body_model(table: &dyn NamedArrays, prefix: &str) -> Option<Layout> {
    const IDENTITY: Recipe = Recipe::new("shape", &["v_template"], "shapedirs", Scale::Already);
    const SKELETAL: Recipe =
        Recipe::new("shape", &["skin_template_v"], "shapedirs", Scale::Already);
    let sides = |name: &str| table.shape(&format!("{prefix}{name}"))?.ok();
    let product = |sides: &[u64]| sides.iter().try_fold(1_u64, |all, &side| all.checked_mul(side));
    let basis = product(&sides("shapedirs")?)?;
    let (recipe, faces): (_, &'static [&'static str]) = if sides("v_template").is_some() {
        (IDENTITY, &["f"])
    } else {
        (SKELETAL, &["skin_template_f"])
    };
    let length = product(&sides(recipe.mean[0])?)?;
    let modes = usize::try_from(basis.checked_div(length)?).ok()?;
    let joints = match sides("kintree_table").as_deref() {
        Some(&[2, joints]) => Some(joints),
        _ => sides("J_regressor").and_then(|sides| sides.first().copied()),
    };
    let name = match (joints, length / 3) {
        _ if recipe.mean[0] == "skin_template_v" => "SKEL",
        (Some(5), _) | (None, 5023) => "FLAME",
        (Some(16), _) | (None, 778) => "MANO",
        (Some(24), _) | (None, 6890) => match sides("posedirs").as_deref() {
            Some([.., 93]) => "STAR",
            _ => "SMPL",
        },
        (Some(52), _) => "SMPL+H",
        (Some(55), _) | (None, 10_475) => "SMPL-X",
        // No other format has 300 modes of identity and 100 of expression.
        _ if modes == 400 => "FLAME or SMPL-X",
        _ => return None,
    };
    let mut notes = Vec::new();
    let identity = match modes {
        _ if !matches!(name, "FLAME" | "SMPL-X" | "FLAME or SMPL-X") => modes,
        400 => 300,
        20 => 10,
        0..=10 => modes,
        _ => {
            notes.push(format!(
                "All {modes} modes were taken as identity: which of them are expression is known of \
                 models of 400 and of 20 modes."
            ));
            modes
        }
    };
    let mut parts = vec![recipe];
    if identity < modes {
        notes.push(format!(
            "Of the {modes} modes the first {identity} are identity and the other {} expression, as \
             {name} has it.",
            modes - identity
        ));
        parts[0].modes = Some((0, identity));
        parts.push(Recipe { part: "expression", modes: Some((identity, modes)), ..recipe });
    }
    if name == "MANO" {
        notes.push(
            "If this is the left hand, its modes are those of the right hand: negate their x before \
             hands are compared."
                .to_owned(),
        );
    }
    Some(Layout {
        prefix: prefix.to_owned(),
        name,
        unit: Unit::Metre,
        faces,
        counting: Counting::Open,
        map: None,
        parts,
        notes,
    })
}

fn no_model(table: &dyn NamedArrays) -> Fault {
    let described = |name: &String| match table.shape(name) {
        Some(Ok(shape)) => format!("{name} ({})", shape_text(&shape)),
        Some(Err(
            Fault::NotNumbers { found: holds, .. } | Fault::PickleClass { class: holds, .. },
        )) => {
            format!("{name} ({holds})")
        }
        _ => name.clone(),
    };
    table.damage().unwrap_or_else(|| Fault::NoModel {
        format: table.container(),
        contents: table.names().iter().take(MOST_NAMES).map(described).collect(),
    })
}

/// Reads one part, and the name that the file gives it.
fn read_part(
    table: &mut dyn NamedArrays,
    layout: &Layout,
    recipe: &Recipe,
    reading: &Reading,
) -> Result<(Part, Option<String>), Fault> {
    // R names the coordinates of a matrix of shapes, and prcomp the rows of its modes after them.
    let named = table.labels(&format!("{}{}", layout.prefix, recipe.basis));
    let mut reading = reading.clone();
    if let Some(axes) = named.first().and_then(|rows| axes_of(rows)) {
        reading.dimension.get_or_insert(axes.dimension);
        reading.order.get_or_insert(axes.order);
    }
    let mut source = Source { table, prefix: &layout.prefix };
    let mut notes = layout.notes.clone();
    let general = layout.name.is_empty();
    let mut mean = source.sum(recipe.mean)?;
    let length = mean.array.data.len();
    let mut basis = source.required(recipe.basis)?;
    let all = basis.array.data.len().checked_div(length).unwrap_or(0);
    if let Some((start, end)) = recipe.modes {
        basis.array = modes_of(&basis.array, all, start, end).ok_or_else(|| Fault::Shape {
            first: format!("Mean has {length} numbers"),
            second: format!("{} is {}", basis.name, shape_text(&basis.array.shape)),
        })?;
    }
    let modes = basis.array.data.len().checked_div(length).unwrap_or(0);
    let mut scaling = source.scaling(recipe, &basis.array, modes)?;
    if recipe.is_color() {
        darken(&mut mean, &mut basis, &mut scaling, &mut notes)?;
    }
    let rows = match recipe.basis {
        "modes" => source.numbers("SD", length)?,
        // What R divided the coordinates by, unless it is FALSE.
        "rotation" if length > 1 => source.numbers("scale", length)?,
        _ => None,
    };
    let scores = match layout.name {
        "gias3" => source.scores("projectedWeights", &mut notes),
        "" => source
            .scores("training_coefficients", &mut notes)
            .or_else(|| source.scores_by_shape(modes, &mut notes)),
        _ => None,
    };
    let noise = if general { source.noise_variance()? } else { 0.0 };
    let faces = source.faces(layout, &mut notes);
    let kind = match source.text("kind", general)?.as_deref() {
        _ if recipe.is_color() => Kind::Color,
        Some("color") => Kind::Color,
        Some("displacement") => Kind::Displacement,
        _ => Kind::Shape,
    };
    let unit = match source.text("unit", general)? {
        Some(symbol) => Unit::from_symbol(&symbol).unwrap_or_default(),
        None if kind == Kind::Color => Unit::Unknown,
        None => layout.unit,
    };
    let own_name = source.text("name", general)?.filter(|name| !name.is_empty());
    // Faces lie on the shape: only there it can be seen which way they point.
    let (cells, borrowed) = match layout.parts.first() {
        Some(shape) if recipe.is_color() && !shape.is_color() => {
            let mesh = mesh_of(source.sum(shape.mean)?, None, faces, Habit::CellsFirst)?;
            (None, (mesh.0.len() == length).then_some(mesh.1))
        }
        _ => (faces, None),
    };
    let map = match layout.map {
        Some(name) => source.map(name, length / 3, &mut notes)?,
        None => None,
    };
    let assembled = assemble(Ingredients {
        mean,
        basis,
        scaling,
        points: None,
        cells,
        habit: Habit::CellsFirst,
        base: None,
        rows,
        scores: scores.map(Scores::plain),
        kind,
        order_stated: !layout.name.is_empty(),
        reading,
    })?;
    notes.extend(assembled.notes);
    let mut model = assembled.model.with_unit(unit).with_noise_variance(noise);
    if let Some(cells) = borrowed.filter(|cells| *cells != Cells::None) {
        model = model.with_cells(cells).map_err(Fault::Model)?;
    }
    let name = if kind == Kind::Color { "color" } else { recipe.part }.to_owned();
    let (check, origin) = (assembled.check, Origin::File);
    Ok((Part { name, model, check, origin, map, notes, findings: assembled.findings }, own_name))
}

/// The modes from `start` to `end` of a basis with `modes` of them on its last side.
fn modes_of(basis: &Array, modes: usize, start: usize, end: usize) -> Option<Array> {
    fn cut<T: Copy>(values: &[T], modes: usize, start: usize, end: usize) -> Vec<T> {
        values.chunks_exact(modes).flat_map(|row| &row[start..end]).copied().collect()
    }
    if start >= end || end > modes || !basis.data.len().is_multiple_of(modes) {
        return None;
    }
    let data = match &basis.data {
        Data::F64(values) => Data::F64(cut(values, modes, start, end)),
        Data::F32(values) => Data::F32(cut(values, modes, start, end)),
        Data::I64(values) => Data::I64(cut(values, modes, start, end)),
        Data::I32(values) => Data::I32(cut(values, modes, start, end)),
        Data::Text(_) => return None,
    };
    Some(Array { shape: vec![basis.data.len() / modes, end - start], data })
}

/// Divides colours in 0…255 by 255.
fn darken(
    mean: &mut Named,
    basis: &mut Named,
    scaling: &mut Scaling,
    notes: &mut Vec<String>,
) -> Result<(), Fault> {
    const BRIGHTEST: f64 = 255.0;
    let divided = |named: &mut Named| -> Result<(), Fault> {
        let shape = named.array.shape.clone();
        let array = core::mem::replace(&mut named.array, Array::list(Vec::new()));
        let mut values = array.into_f64().ok_or_else(|| not_numbers(&named.name, "text"))?;
        values.iter_mut().for_each(|value| *value /= BRIGHTEST);
        named.array = Array { shape, data: Data::F64(values) };
        Ok(())
    };
    let largest = mean.array.clone().into_f64().unwrap_or_default();
    if largest.into_iter().fold(0.0, f64::max) <= 2.0 {
        return Ok(());
    }
    divided(mean)?;
    match scaling {
        Scaling::Unit(variances) => {
            variances.iter_mut().for_each(|variance| *variance /= BRIGHTEST * BRIGHTEST);
        }
        _ => divided(basis)?,
    }
    notes.push("The colours of the file run from 0 to 255; they were divided by 255.".to_owned());
    Ok(())
}

/// The arrays of one group.
struct Source<'a> {
    table: &'a mut dyn NamedArrays,
    prefix: &'a str,
}

impl Source<'_> {
    fn full(&self, name: &str) -> String {
        format!("{}{name}", self.prefix)
    }

    /// The shape of an array that can be read.
    fn shape(&self, name: &str) -> Option<Vec<u64>> {
        self.table.shape(&self.full(name))?.ok()
    }

    /// The array of that name; `None` when there is none, a fault when it holds no numbers.
    fn array(&mut self, name: &str) -> Result<Option<Named>, Fault> {
        let full = self.full(name);
        match self.table.shape(&full) {
            None => Ok(None),
            Some(Err(fault)) => Err(fault),
            Some(Ok(_)) => Ok(Some(Named { array: self.table.read(&full)?, name: full })),
        }
    }

    fn required(&mut self, name: &str) -> Result<Named, Fault> {
        self.array(name)?.ok_or_else(|| no_model(self.table))
    }

    /// The sum of arrays.
    fn sum(&mut self, names: &[&str]) -> Result<Named, Fault> {
        let (first, others) = names.split_first().ok_or_else(|| no_model(self.table))?;
        let mut sum = self.required(first)?;
        for name in others {
            let other = self.required(name)?;
            let sides =
                |named: &Named| format!("{} is {}", named.name, shape_text(&named.array.shape));
            let (first, second) = (sides(&sum), sides(&other));
            let shape = sum.array.shape.clone();
            let values = sum.array.into_f64().ok_or_else(|| not_numbers(&sum.name, "text"))?;
            let others = other.array.into_f64().ok_or_else(|| not_numbers(&other.name, "text"))?;
            if values.len() != others.len() {
                return Err(Fault::Shape { first, second });
            }
            let values = DVector::from_vec(values) + DVector::from_vec(others);
            let data = Data::F64(values.as_slice().to_vec());
            sum = Named { name: format!("{} + {name}", sum.name), array: Array { shape, data } };
        }
        Ok(sum)
    }

    /// What is known of the length of the modes.
    fn scaling(&mut self, recipe: &Recipe, basis: &Array, modes: usize) -> Result<Scaling, Fault> {
        let squared = |deviations: Vec<f64>| deviations.iter().map(|sigma| sigma * sigma).collect();
        let list =
            |named: Named| named.array.into_f64().ok_or_else(|| not_numbers(&named.name, "text"));
        match recipe.scale {
            Scale::Variances(name) => Ok(Scaling::Unit(list(self.required(name)?)?)),
            Scale::Deviations(name) => Ok(Scaling::Unit(squared(list(self.required(name)?)?))),
            Scale::Already => Ok(Scaling::AlreadyScaled),
            Scale::Open => {
                if matches!(basis.data, Data::I32(_) | Data::I64(_))
                    && let Some(scale) = self.array("basis_scale")?
                {
                    return Ok(Scaling::Factors(list(scale)?));
                }
                for name in VARIANCES {
                    if let Some(variances) = self.numbers(name, modes)? {
                        return Ok(Scaling::Unit(variances));
                    }
                }
                for name in DEVIATIONS {
                    if let Some(deviations) = self.numbers(name, modes)? {
                        return Ok(Scaling::Unit(squared(deviations)));
                    }
                }
                // `weights` of another length are those of a skeleton; other names can only mean
                // variances.
                let misfit = |name: &&&str| **name != "weights" && self.shape(name).is_some();
                if let Some(name) = VARIANCES.iter().find(misfit) {
                    return Ok(Scaling::Unit(list(self.required(name)?)?));
                }
                // Of how many shapes, scikit-learn says.
                for count in ["n_samples_", "n_samples_seen_"] {
                    if let Some(&[count]) = self.numbers(count, 1)?.as_deref()
                        && let Some(values) = self.numbers("singular_values_", modes)?
                        && count > 1.0
                    {
                        let variance = |value: &f64| value * value / (count - 1.0);
                        return Ok(Scaling::Unit(values.iter().map(variance).collect()));
                    }
                }
                let singular = |name: &String| {
                    let own = name.strip_prefix(self.prefix).unwrap_or_default();
                    own.to_lowercase().starts_with("singular")
                };
                let shares = |name: &String| name.trim_end_matches('_').ends_with("variance_ratio");
                let names = self.table.names();
                match (
                    names.iter().find(|name| singular(name)),
                    names.iter().find(|name| shares(name)),
                ) {
                    (Some(what), _) => Err(Fault::SingularValues { what: what.clone() }),
                    (None, Some(what)) => Err(Fault::VarianceShares { what: what.clone() }),
                    (None, None) => Ok(Scaling::Unstated),
                }
            }
        }
    }

    /// A list of `length` numbers under this name; `None` when there is none or it has another length.
    fn numbers(&mut self, name: &str, length: usize) -> Result<Option<Vec<f64>>, Fault> {
        let fits = self.shape(name).is_some_and(|shape| {
            shape.iter().filter(|&&side| side != 1).all(|&side| side == length as u64)
        });
        if !fits {
            return Ok(None);
        }
        let array = self.array(name)?.map(|named| named.array);
        Ok(array.filter(|array| array.is_list_of(length)).and_then(Array::into_f64))
    }

    /// Coefficients of the training shapes, in integers times `training_scale` (q) where there is one. A model opens
    /// without them: what cannot be read is said.
    fn scores(&mut self, name: &str, notes: &mut Vec<String>) -> Option<Named> {
        self.shape(name)?;
        let mut read = || -> Result<Option<Named>, Fault> {
            let Some(mut scores) = self.array(name)? else { return Ok(None) };
            let &[modes, count] = scores.array.shape.as_slice() else { return Ok(Some(scores)) };
            if let Some(scale) = self.numbers("training_scale", modes)?
                && let Some(mut values) = scores.array.clone().into_f64()
                && count > 0
            {
                for (row, factor) in values.chunks_exact_mut(count).zip(scale) {
                    row.iter_mut().for_each(|value| *value *= factor);
                }
                scores.array.data = Data::F64(values);
            }
            Ok(Some(scores))
        };
        read().unwrap_or_else(|fault| {
            notes.push(format!("The training shapes could not be read. {fault}"));
            None
        })
    }

    /// Coefficients of the training shapes that have a row for each shape, turned.
    fn scores_by_shape(&mut self, modes: usize, notes: &mut Vec<String>) -> Option<Named> {
        let fits = |name: &&&str| matches!(self.shape(name).as_deref(), Some(&[_, columns]) if columns == modes as u64);
        let name = SCORES_BY_SHAPE.iter().find(fits)?;
        let Named { name, array } = self.scores(name, notes)?;
        let &[rows, columns] = array.shape.as_slice() else { return None };
        let values = array.into_f64()?;
        let turned = (0..values.len()).map(|at| values[at % rows * columns + at / rows]).collect();
        Some(Named { name, array: Array { shape: vec![columns, rows], data: Data::F64(turned) } })
    }

    /// The noise variance of Shapevenn's own export or of scikit-learn's PCA; 0 where there is none.
    fn noise_variance(&mut self) -> Result<f64, Fault> {
        let own = self.numbers("noise_variance", 1)?;
        let of_scikit_learn = self.numbers("noise_variance_", 1)?;
        let found = own.or(of_scikit_learn).and_then(|values| values.first().copied());
        Ok(found.filter(|noise| noise.is_finite() && *noise > 0.0).unwrap_or(0.0))
    }

    /// A text of Shapevenn's own export, the only format with general names.
    fn text(&mut self, name: &str, general: bool) -> Result<Option<String>, Fault> {
        if !general || self.shape(name).is_none() {
            return Ok(None);
        }
        Ok(self.array(name)?.and_then(|named| named.array.first_text()))
    }

    /// The faces, counted from 0 and wound as we do where the layout lays down how they are. They are
    /// only for drawing: what cannot be read is said.
    fn faces(&mut self, layout: &Layout, notes: &mut Vec<String>) -> Option<Array> {
        let has = |name: &&&str| self.table.shape(&self.full(name)).is_some();
        let readable = |name: &&&str| self.shape(name).is_some();
        let names = layout.faces;
        let name = names.iter().find(readable).or_else(|| names.iter().find(has))?;
        match self.array(name) {
            Ok(faces) => Some(recounted(faces?.array, layout.counting)),
            Err(fault) => {
                notes.push(format!(
                    "The faces could not be read, points are shown instead. {fault}"
                ));
                None
            }
        }
    }

    /// For every point its number in a larger mesh.
    fn map(
        &mut self,
        name: &str,
        points: usize,
        notes: &mut Vec<String>,
    ) -> Result<Option<Vec<u32>>, Fault> {
        if self.shape(name).is_none() {
            return Ok(None);
        }
        let numbers = self.array(name)?.and_then(|named| named.array.to_integers());
        let map: Option<Vec<u32>> = numbers
            .and_then(|numbers| numbers.iter().map(|&number| u32::try_from(number).ok()).collect());
        let map = map.filter(|map| map.len() == points);
        if map.is_none() {
            let points = counted(points, "point", "points");
            notes.push(format!(
                "{name} does not have one number for each of {points} and was left out."
            ));
        }
        Ok(map)
    }
}

/// Faces counted from 0 and wound counter-clockwise, of a layout that does otherwise.
fn recounted(faces: Array, counting: Counting) -> Array {
    let (&[rows, columns], Some(mut corners)) = (faces.shape.as_slice(), faces.to_integers())
    else {
        return faces;
    };
    if counting == Counting::Open {
        return faces;
    }
    if corners.iter().min().is_some_and(|&least| least >= 1) {
        corners.iter_mut().for_each(|corner| *corner -= 1);
    }
    if counting == Counting::FromOneReversed {
        if columns == 3 {
            corners.chunks_exact_mut(3).for_each(|face| face.swap(1, 2));
        } else if rows == 3 {
            let (second, third) = corners[columns..].split_at_mut(columns);
            second.swap_with_slice(third);
        }
    }
    Array { shape: vec![rows, columns], data: Data::I64(corners) }
}
