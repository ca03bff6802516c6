//! The scenes of the page's lessons and their links: `page=learn&scene=step&seed=7&steps=120`.
//!
//! | scene | its keys and what they are when left out |
//! |---|---|
//! | model | pair=stars-5 side=a coefficients=1.2,-0.6 |
//! | agree | pair=stars-5 sigma=0.003 |
//! | planes | tilt=50 shift=0.4 lift=0 sigma=0.3 side=a coefficients=0.8,0.8 |
//! | step | pair=planes modes=2 sigma=0.3 side=a sampler=paper-corrected chains=1 seed=1 steps=0 |
//! | cloud | pair=stars-5 sigma=0.003 sampler=independence chains=8 seed=1 draws=2000 |
//! | difference | pair=planes modes=2 sigma=0.3 side=a seed=1 draws=1000 |
//! | race | pair=stars-5 modes=all sigma=0.003 side=a chains=4 seed=1 steps=500 break=none |
//!
//! Every scene also reads `plausibility`, `turned`, `tilt`, `shift`, `lift`, `burnin`, as far as they mean something
//! to it. Other keys are those of the page's picture and are passed over, by name.

use crate::model::Side;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::LessonError;
use super::ask::{LessonSampler, Opening};

/// The scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum SceneName {
    /// What a model is: a shape, its coefficients, its plausibility.
    Model,
    /// Where two models agree, tip by tip.
    Agree,
    /// Projection, distance and likelihood on two planes.
    Planes,
    /// The paper's walk, one step after the other.
    Step,
    /// Draws of both sides, and the intersection made of them.
    Cloud,
    /// Draws of the difference, and why they make no model.
    Difference,
    /// Samplers beside one another, whole and broken.
    Race,
}

/// What is broken in a race.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Break {
    /// Nothing.
    #[default]
    None,
    /// The Hastings factor of the walk's scaling move, on N(0, I₅₀).
    Scaling,
    /// Only one chain runs.
    OneChain,
    /// σ is a thirtieth of what it should be.
    Sigma,
    /// B is turned by 8° before it is compared.
    Misaligned,
}

/// Bounds of a number of a scene, in a link and on the page.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SceneBounds {
    /// Of which scene.
    pub scene: SceneName,
    /// Its key in links.
    pub key: &'static str,
    /// The least value, of each where there are several.
    pub least: f64,
    /// The largest.
    pub most: f64,
    /// Digits after the point in a link.
    pub digits: u8,
}

/// The bounds of all numbers of scenes: the page has its sliders from them.
pub const SCENE_BOUNDS: [SceneBounds; 18] = {
    use SceneName::{Agree, Cloud, Difference, Model, Planes, Race, Step};
    const fn of(scene: SceneName, key: &'static str, range: [f64; 2], digits: u8) -> SceneBounds {
        let [least, most] = range;
        SceneBounds { scene, key, least, most, digits }
    }
    [
        of(Model, "coefficients", [-6.0, 6.0], 2),
        of(Agree, "sigma", [0.0001, 3.0], 5),
        of(Planes, "tilt", [0.0, 90.0], 0),
        of(Planes, "shift", [-2.0, 2.0], 2),
        of(Planes, "lift", [-1.5, 1.5], 2),
        of(Planes, "sigma", [0.01, 3.0], 3),
        of(Planes, "coefficients", [-6.0, 6.0], 2),
        of(Step, "sigma", [0.001, 3.0], 3),
        of(Step, "chains", [1.0, 16.0], 0),
        of(Step, "steps", [0.0, 20_000.0], 0),
        of(Cloud, "sigma", [0.0001, 3.0], 5),
        of(Cloud, "chains", [1.0, 16.0], 0),
        of(Cloud, "draws", [16.0, 20_000.0], 0),
        of(Difference, "sigma", [0.001, 3.0], 3),
        of(Difference, "draws", [16.0, 5000.0], 0),
        of(Race, "sigma", [0.0001, 3.0], 5),
        of(Race, "chains", [1.0, 16.0], 0),
        of(Race, "steps", [16.0, 5000.0], 0),
    ]
};

/// A scene with all that makes its numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Scene {
    /// Which one.
    pub scene: SceneName,
    /// What is compared, and how.
    #[serde(flatten)]
    pub opening: Opening,
    /// Whose shapes.
    pub side: Side,
    /// The shape that is looked at.
    pub coefficients: Vec<f64>,
    /// How draws are made.
    pub sampler: LessonSampler,
    /// Chains, of each side or sampler.
    pub chains: usize,
    /// Seed of every random number.
    pub seed: String,
    /// Steps of each chain that are thrown away at its start; as the sampler asks where left out.
    pub burn_in: Option<usize>,
    /// Steps of each chain after that.
    pub steps: usize,
    /// Draws, of each side.
    pub draws: usize,
    /// What is broken.
    #[serde(rename = "break")]
    pub broken: Break,
}

impl Scene {
    /// A scene as it opens.
    pub fn of(scene: SceneName) -> Self {
        let opening = |pair: &str, modes, sigma| Opening {
            pair: pair.to_owned(),
            modes,
            sigma: Some(sigma),
            ..Opening::default()
        };
        let plain = Self {
            scene,
            opening: opening("planes", None, 0.3),
            side: Side::A,
            coefficients: Vec::new(),
            sampler: LessonSampler::PaperCorrected,
            chains: 1,
            seed: "1".to_owned(),
            burn_in: None,
            steps: 0,
            draws: 0,
            broken: Break::None,
        };
        match scene {
            SceneName::Model => {
                let opening = opening("stars-5", None, 0.003);
                Self { opening, coefficients: vec![1.2, -0.6], ..plain }
            }
            SceneName::Agree => Self { opening: opening("stars-5", None, 0.003), ..plain },
            SceneName::Planes => Self { coefficients: vec![0.8, 0.8], ..plain },
            SceneName::Step => Self { opening: opening("planes", Some(2), 0.3), ..plain },
            SceneName::Cloud => {
                let opening = opening("stars-5", None, 0.003);
                let sampler = LessonSampler::Independence;
                Self { opening, sampler, chains: 8, draws: 2000, ..plain }
            }
            SceneName::Difference => {
                let opening = opening("planes", Some(2), 0.3);
                Self { opening, sampler: LessonSampler::Rejection, draws: 1000, ..plain }
            }
            SceneName::Race => {
                let opening = opening("stars-5", None, 0.003);
                Self { opening, chains: 4, steps: 500, burn_in: Some(200), ..plain }
            }
        }
    }

    /// The scene of a link, by its keys and values, and the keys that do not change its numbers.
    ///
    /// # Errors
    /// [`LessonError`] when it names no scene, or a value cannot be read.
    pub fn of_link(pairs: &[(String, String)]) -> Result<(Self, Vec<String>), LessonError> {
        let Some((_, name)) = pairs.iter().find(|(key, _)| key == "scene") else {
            let message = "The link names no scene: scene=… was expected among its keys".to_owned();
            return Err(LessonError::Unreadable { message });
        };
        let scenes = "one of model, agree, planes, step, cloud, difference, race";
        let mut scene = Self::of(word("The scene", name, scenes)?);
        let mut others = Vec::new();
        for (key, value) in pairs {
            if !scene.set(key, value)? {
                others.push(key.clone());
            }
            check_bounds(scene.scene, key, value)?;
        }
        Ok((scene, others))
    }

    /// Takes a key; whether it is one.
    fn set(&mut self, key: &str, value: &str) -> Result<bool, LessonError> {
        match key {
            "page" | "v" | "scene" => {}
            "pair" => value.clone_into(&mut self.opening.pair),
            "modes" => {
                let modes = (value != "all").then(|| count("The number of modes", value));
                self.opening.modes = modes.transpose()?;
            }
            "sigma" => self.opening.sigma = Some(number("σ", value)?),
            "plausibility" => {
                let expected = "product or idempotent";
                self.opening.plausibility = word("The plausibility", value, expected)?;
            }
            "turned" => self.opening.turned = number("The turn", value)?,
            "tilt" => self.opening.tilt = number("The tilt", value)?,
            "shift" => self.opening.shift = number("The shift", value)?,
            "lift" => self.opening.lift = number("The lift", value)?,
            "side" => self.side = word("The side", value, "a or b")?,
            "coefficients" => {
                let each = value.split(',').filter(|part| !part.is_empty());
                let numbers = each.map(|part| number("A coefficient", part));
                self.coefficients = numbers.collect::<Result<_, _>>()?;
            }
            "sampler" => {
                let expected =
                    "one of paper, paper-corrected, mala, hmc, independence, pcn, rejection";
                self.sampler = word("The sampler", value, expected)?;
            }
            "chains" => self.chains = count("The number of chains", value)?,
            "seed" => value.clone_into(&mut self.seed),
            "burnin" => self.burn_in = Some(count("The burn-in", value)?),
            "steps" => self.steps = count("The number of steps", value)?,
            "draws" => self.draws = count("The number of draws", value)?,
            "break" => {
                let expected = "one of none, scaling, one-chain, sigma, misaligned";
                self.broken = word("What is broken", value, expected)?;
            }
            _ => return Ok(false),
        }
        Ok(true)
    }
}

/// Refuses a number outside its bounds; what is no number is refused where it is read.
fn check_bounds(scene: SceneName, key: &str, value: &str) -> Result<(), LessonError> {
    let known = SCENE_BOUNDS.iter().find(|bounds| bounds.scene == scene && bounds.key == key);
    let Some(SceneBounds { key, least, most, .. }) = known else { return Ok(()) };
    let mut numbers = value.split(',').filter_map(|number| number.parse::<f64>().ok());
    if numbers.all(|number| (*least..=*most).contains(&number)) {
        return Ok(());
    }
    let expected = format!("from {least} to {most}");
    Err(unexpected(key, &expected, value))
}

fn unexpected(what: &'static str, expected: &str, found: &str) -> LessonError {
    LessonError::Value { what, expected: expected.to_owned(), found: found.to_owned() }
}

fn word<T: DeserializeOwned>(
    what: &'static str,
    found: &str,
    expected: &str,
) -> Result<T, LessonError> {
    serde_json::from_value(Value::String(found.to_owned()))
        .map_err(|_| unexpected(what, expected, found))
}

fn number(what: &'static str, found: &str) -> Result<f64, LessonError> {
    found.parse().map_err(|_| unexpected(what, "a number", found))
}

fn count(what: &'static str, found: &str) -> Result<usize, LessonError> {
    found.parse().map_err(|_| unexpected(what, "a whole number", found))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys and values as they are written in a link.
    fn of_link(text: &str) -> Result<(Scene, Vec<String>), LessonError> {
        let pairs = text.split('&').filter_map(|pair| pair.split_once('='));
        let owned = |(key, value): (&str, &str)| (key.to_owned(), value.to_owned());
        Scene::of_link(&pairs.map(owned).collect::<Vec<_>>())
    }

    #[test]
    fn what_is_left_out_of_a_link_has_its_default() {
        let link = "page=learn&scene=step&seed=7&steps=120&camera=1,2&coefficients=1,-0.5";
        let (scene, others) = of_link(link).unwrap();
        let expected = Scene {
            seed: "7".to_owned(),
            steps: 120,
            coefficients: vec![1.0, -0.5],
            ..Scene::of(SceneName::Step)
        };
        assert_eq!(scene, expected, "what is left out has its default");
        assert_eq!(others, ["camera"], "the picture's own keys are told");
    }

    #[test]
    fn every_scene_opens_by_its_name_and_all_modes_can_be_asked_for() {
        for name in ["model", "agree", "planes", "step", "cloud", "difference", "race"] {
            assert!(of_link(&format!("scene={name}")).is_ok(), "{name}");
        }
        let (scene, _) = of_link("scene=step&modes=all&sampler=paper").unwrap();
        assert_eq!((scene.opening.modes, scene.sampler), (None, LessonSampler::Paper), "set");
        assert!(of_link("scene=planes&tilt=90&coefficients=6,-6").is_ok(), "bounds may be reached");
    }

    #[test]
    fn faults_name_what_was_expected_and_what_was_found() {
        for (link, expected) in [
            ("scene=planes&tilt=90.5", "tilt must be from 0 to 90, not “90.5”."),
            (
                "scene=planes&coefficients=1,-6.5",
                "coefficients must be from -6 to 6, not “1,-6.5”.",
            ),
            ("scene=step&sigma=NaN", "sigma must be from 0.001 to 3, not “NaN”."),
            ("page=learn", "The link names no scene: scene=… was expected among its keys."),
            ("scene=step&steps=-1", "The number of steps must be a whole number, not “-1”."),
            ("scene=step&side=c", "The side must be a or b, not “c”."),
            ("scene=agree&sigma=small", "σ must be a number, not “small”."),
            (
                "scene=race&break=all",
                "What is broken must be one of none, scaling, one-chain, sigma, misaligned, not “all”.",
            ),
        ] {
            let error = of_link(link).unwrap_err();
            assert_eq!(error.to_string(), expected, "{link}");
        }
    }
}
