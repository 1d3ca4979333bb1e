//! Keys of `[fdm]` that take no effect.

use crate::case::load_str;

fn diagnostics(fdm: &str) -> String {
    let case = format!(
        "projectile = {{ material = 'copper', length = '12 mm', diameter = '5 mm', impact_velocity = '200 m/s' }}\n\
         target = {{ material = 'aluminium-2024-t351', thickness = '25 mm' }}\n[fdm]\n{fdm}"
    );
    load_str("case", &case).map_or_else(|error| error.to_string(), |_| String::new())
}

#[test]
fn keys_without_effect_are_named() {
    assert_eq!(diagnostics("geometry = 'rod'\ncourant = 0.5"), "");
    assert!(diagnostics("spall_strength = '1 GPa'").contains("fdm.spall_strength"));
    assert!(diagnostics("geometry = 'planar'\nborder_shear = 0.5").contains("fdm.border_shear"));
    assert!(diagnostics("projectile_elements = 0").contains("out of range"));
    assert!(diagnostics("geometry = 'disc'").contains("disc"));
}
