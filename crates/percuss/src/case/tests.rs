use super::*;
const SHORT: &str = r#"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", velocity = "230 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
"#;

#[test]
fn a_short_case_resolves() {
    let scenario = load_str("short", SHORT).unwrap();
    assert_eq!(scenario.projectile.material_id, "copper-woodward");
    assert!((scenario.projectile.mass / 1.96e-3 - 1.0).abs() < 1e-3);
}
