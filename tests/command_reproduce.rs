//! `ringroad reproduce`, run as a person runs it.
#![cfg(all(feature = "command", not(target_arch = "wasm32")))]

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

fn ringroad(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ringroad")).args(arguments).output().unwrap()
}

#[test]
fn json_is_a_list_of_claims_with_seven_fields() {
    let output = ringroad(&["reproduce", "fundamental-diagram", "--small", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let claims: Vec<Value> = serde_json::from_slice(&output.stdout).unwrap();
    assert!(claims.len() >= 6);
    for claim in &claims {
        let names: Vec<_> = claim.as_object().unwrap().keys().cloned().collect();
        assert_eq!(names, ["claim", "figure", "method", "ours", "paper", "uncertainty", "verdict"]);
        assert_eq!(claim["figure"], "fundamental-diagram");
        let verdict = claim["verdict"].as_str().unwrap();
        assert!(["agrees", "differs", "not determined by the paper"].contains(&verdict), "{verdict}");
    }
    let flow = claims.iter().find(|c| c["claim"].as_str().unwrap().contains("q*")).unwrap();
    assert!((flow["ours"].as_f64().unwrap() - 2065.0).abs() < 0.5);
}

#[test]
fn a_folder_gets_tables_pictures_and_claims_the_same_every_time() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("reproduce");
    let _ = fs::remove_dir_all(&folder);
    let run = || {
        let arguments = [
            "reproduce",
            "load-balance",
            "fundamental-diagram",
            "--small",
            "--out",
            folder.to_str().unwrap(),
        ];
        let output = ringroad(&arguments);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let mut files: Vec<_> = fs::read_dir(&folder)
            .unwrap()
            .map(|f| f.unwrap())
            .map(|f| (f.file_name().into_string().unwrap(), fs::read(f.path()).unwrap()))
            .collect();
        files.sort();
        (files, String::from_utf8(output.stdout).unwrap())
    };
    let (files, text) = run();
    let names: Vec<_> = files.iter().map(|f| f.0.as_str()).collect();
    assert_eq!(
        names,
        [
            "claims.json",
            "fundamental-diagram-flow.csv",
            "fundamental-diagram-rings.csv",
            "fundamental-diagram-speed.csv",
            "fundamental-diagram.svg",
            "load-balance-tenth.csv",
            "load-balance.csv",
            "load-balance.svg",
        ]
    );
    // In the order of the paper, whatever the order of the arguments.
    assert!(text.find("fundamental-diagram\n").unwrap() < text.find("load-balance\n").unwrap());
    assert_eq!(run().0, files);
}

#[test]
fn an_unknown_figure_is_refused_by_name() {
    let output = ringroad(&["reproduce", "all", "figure-7"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let message = String::from_utf8(output.stderr).unwrap();
    for word in ["figure-7", "fundamental-diagram", "load-balance", "all"] {
        assert!(message.contains(word), "{message}");
    }
}

/// Every claim as it is computed stands in the document, no other does, and their number is told rightly.
#[test]
fn the_document_says_what_the_program_gives() {
    let output = ringroad(&["reproduce", "all", "--markdown"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let table = String::from_utf8(output.stdout).unwrap();
    let document = include_str!("../docs/reproduction.md");
    let (_, from_claims) = document.split_once("\n## The claims\n").unwrap();
    let (claims, _) = from_claims.split_once("\n## ").unwrap();
    let written: Vec<_> = claims.lines().filter(|line| line.starts_with('|')).collect();
    let given: Vec<_> = table.lines().collect();
    for (written, given) in written.iter().zip(&given) {
        assert_eq!(written, given);
    }
    assert_eq!(written.len(), given.len());
    let count = |verdict| given.iter().filter(|row| row.split(" | ").nth(3) == Some(verdict)).count();
    let sum = format!(
        "{} claims: {} agree, {} differ, {} are not determined by the paper.",
        given.len() - 2,
        count("agrees"),
        count("differs"),
        count("not determined by the paper")
    );
    assert!(claims.contains(&sum), "{sum}");
}
