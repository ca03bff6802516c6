//! `shapevenn lesson`, as a shell sees it: the numbers of every scene, and what is said of links that are none.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::process::{Command, Output};

use serde_json::{Value, json};

fn lesson(arguments: &[&str]) -> Output {
    let all = [&["lesson"], arguments].concat();
    Command::new(env!("CARGO_BIN_EXE_shapevenn")).args(all).output().unwrap()
}

/// The numbers of a link, of a call that says nothing else.
fn scene_numbers(link: &str) -> Value {
    let output = lesson(&[link, "--json"]);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{link}: nothing on standard error");
    assert_eq!(output.status.code(), Some(0), "{link}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn real(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("a number, not {value}"))
}

#[test]
fn every_scene_has_its_numbers() {
    let model = scene_numbers("page=learn&scene=model&coefficients=1,2");
    assert_eq!(model["point"]["logPrior"], -2.5, "−½‖a‖²");
    assert_eq!(model["settings"]["pair"], "stars-5", "the pair when left out");

    let agree = scene_numbers("scene=agree");
    let tips = agree["tips"].as_array().unwrap();
    assert_eq!(tips.len(), 5, "five tips");
    let [shared, of_a] = [&tips[0], &tips[2]];
    assert!(real(&shared["intersection"]) > 10.0 * real(&of_a["intersection"]), "tip 0 is shared");
    assert!(real(&of_a["a"]) > 1.0 && real(&of_a["b"]) < 1e-9, "tip 2 is A's alone");

    let planes = scene_numbers("scene=planes&coefficients=1,0.5");
    let expected = 0.5 * libm::sin(50_f64.to_radians());
    assert!((real(&planes["point"]["distance"]) - expected).abs() < 1e-12, "|y| sin 50°");
    assert!((real(&planes["angles"][1]) - 50.0).abs() < 1e-9, "their angle");

    let step = scene_numbers("scene=step&steps=40&seed=3&chains=2");
    assert_eq!(step["figures"]["draws"], 80, "two chains of 40");
    assert_eq!(step["lastStep"]["chain"], 1, "the last one's last");
    assert_eq!(scene_numbers("scene=step")["lastStep"], Value::Null, "no step, nothing to tell of");

    let difference = scene_numbers("scene=difference");
    assert_eq!(difference["figures"]["draws"], 1000, "as many as asked");
    let [misled, draws] =
        ["misled", "misledDraws"].map(|name| real(&difference["principal"][name]));
    assert!(misled > 1.5 * draws, "{misled} of the Gaussian, {draws} of the draws");

    let cloud = scene_numbers("scene=cloud&sampler=independence");
    let falls = cloud["intersection"]["falls"].as_array().unwrap();
    let counts: Vec<&Value> = falls.iter().map(|fall| &fall["draws"]).collect();
    assert_eq!(json!(counts), json!([20, 50, 100, 200, 500, 1000, 2000]), "by 1, 2, 5");
    assert!(real(&cloud["intersection"]["grassmann"]) < 0.01, "near the truth");
}

#[test]
fn a_race_is_run_by_five_and_broken_in_four_ways() {
    let of = |link: &str, index: usize, name: &str| {
        real(&scene_numbers(link)["race"][index]["figures"][name])
    };
    let race = scene_numbers("scene=race");
    let names: Vec<&Value> =
        race["race"].as_array().unwrap().iter().map(|one| &one["sampler"]).collect();
    let expected = ["paper", "paper-corrected", "mala", "hmc", "independence"];
    assert_eq!(json!(names), json!(expected), "the racers");
    let yields = [1, 4].map(|index| of("scene=race", index, "essPerThousand"));
    assert!(yields[1] > 50.0 * yields[0], "{yields:?} effective draws");
    let scaling = scene_numbers("scene=race&break=scaling&steps=2000");
    assert_eq!(scaling["race"].as_array().unwrap().len(), 2, "the walks alone");
    assert!(real(&scaling["race"][0]["figures"]["meanSquare"]) < 0.7, "shrunk");
    assert_eq!(of("scene=race&break=one-chain", 3, "chains"), 1.0, "one chain");
    let frozen = of("scene=race&break=sigma", 1, "acceptance");
    assert!(frozen < 0.03, "the walk hardly moves: {frozen}");
    assert!(of("scene=race&break=misaligned", 4, "meanDistance") > 0.1, "the models lie apart");
}

#[test]
fn an_address_gives_the_same_bytes_as_its_fragment_every_time() {
    let fragment = "page=learn&scene=step&seed=7&steps=120";
    let address = format!("https://example.org/shapevenn/?serial#{fragment}");
    let first = lesson(&[fragment, "--json"]).stdout;
    assert_eq!(lesson(&[&address, "--json"]).stdout, first, "the address");
    assert_eq!(lesson(&[fragment, "--json"]).stdout, first, "again");
    assert_ne!(lesson(&["scene=step&seed=8&steps=120", "--json"]).stdout, first, "another seed");
}

#[test]
fn text_has_the_numbers_by_their_paths_and_names_other_keys() {
    let output = lesson(&["scene=planes&coefficients=1,0.5&camera=1,2,3"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let line = text.lines().find(|line| line.starts_with("point.distance ")).unwrap();
    assert_eq!(line.split_whitespace().last(), Some("0.383022"), "{text}");
    assert!(text.contains("! camera does not change the numbers of a scene"), "{text}");
}

#[test]
fn a_bad_link_ends_with_two_and_says_what_was_expected_found_and_to_do() {
    for (link, said, hint) in [
        ("page=learn", "names no scene", "A link to a scene looks like page=learn&scene=step"),
        (
            "scene=steps",
            "The scene must be one of model, agree, planes, step, cloud, difference, race, not “steps”.",
            "Change it",
        ),
        (
            "scene=step&pair=stars-9",
            "The pair must be one of stars-1 to stars-6, or planes, not “stars-9”.",
            "Change it",
        ),
        ("scene=step&chains=65", "chains must be from 1 to 16, not “65”.", "Change it"),
        (
            "scene=step&seed=x",
            "The seed must be a whole number of up to 64 bits, not “x”.",
            "Change it",
        ),
        (
            "scene=planes&coefficients=1,2,3",
            "The list of coefficients must be at most 2 finite numbers, not “1, 2, 3”.",
            "Change it",
        ),
        ("scene=cloud&sampler=gibbs", "not “gibbs”.", "Change it"),
        (
            "scene=cloud&pair=stars-5&sigma=0",
            "sigma must be from 0.0001 to 3, not “0”.",
            "Change it",
        ),
        (
            "scene=difference&tilt=0",
            "B holds every shape of A: the difference is empty.",
            "Choose models",
        ),
    ] {
        let output = lesson(&[link]);
        let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{link}: {complaint}");
        assert!(complaint.contains(said), "{link}: {complaint}");
        assert!(complaint.contains(hint), "{link}: {complaint}");
        assert!(output.stdout.is_empty(), "{link}: nothing on standard output");
    }
}
