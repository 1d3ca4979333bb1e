//! Groups of materials: what a material is made of, for lists and searches.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a material is made of.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum MaterialGroup {
    /// Iron and steel.
    Steel,
    /// Aluminium and its alloys.
    Aluminium,
    /// Copper, brass and bronze.
    Copper,
    /// Titanium and its alloys.
    Titanium,
    /// Magnesium and its alloys.
    Magnesium,
    /// Nickel and its alloys.
    Nickel,
    /// Tungsten and its heavy alloys.
    Tungsten,
    /// Tantalum, molybdenum, niobium, vanadium, zirconium, hafnium and their alloys.
    RefractoryMetal,
    /// Uranium, thorium and their alloys.
    Actinide,
    /// Gold, silver, platinum and their alloys.
    PreciousMetal,
    /// Beryllium, lead, tin, zinc, cadmium and other metals.
    OtherMetal,
    /// Cemented carbides.
    HardMetal,
    /// Ceramics.
    Ceramic,
    /// Glass.
    Glass,
    /// Polymers without fibres.
    Polymer,
    /// Concrete, mortar and stone.
    Concrete,
}

impl MaterialGroup {
    /// All groups, in the order of lists.
    pub const ALL: [Self; 16] = [
        Self::Steel,
        Self::Aluminium,
        Self::Copper,
        Self::Titanium,
        Self::Magnesium,
        Self::Nickel,
        Self::Tungsten,
        Self::RefractoryMetal,
        Self::Actinide,
        Self::PreciousMetal,
        Self::OtherMetal,
        Self::HardMetal,
        Self::Ceramic,
        Self::Glass,
        Self::Polymer,
        Self::Concrete,
    ];

    /// The name that files and commands have.
    pub fn key(self) -> &'static str {
        match self {
            Self::Steel => "steel",
            Self::Aluminium => "aluminium",
            Self::Copper => "copper",
            Self::Titanium => "titanium",
            Self::Magnesium => "magnesium",
            Self::Nickel => "nickel",
            Self::Tungsten => "tungsten",
            Self::RefractoryMetal => "refractory_metal",
            Self::Actinide => "actinide",
            Self::PreciousMetal => "precious_metal",
            Self::OtherMetal => "other_metal",
            Self::HardMetal => "hard_metal",
            Self::Ceramic => "ceramic",
            Self::Glass => "glass",
            Self::Polymer => "polymer",
            Self::Concrete => "concrete",
        }
    }

    /// The group in words, as a heading.
    pub fn describe(self) -> &'static str {
        match self {
            Self::Steel => "Iron and steel",
            Self::Aluminium => "Aluminium alloys",
            Self::Copper => "Copper and brass",
            Self::Titanium => "Titanium alloys",
            Self::Magnesium => "Magnesium alloys",
            Self::Nickel => "Nickel alloys",
            Self::Tungsten => "Tungsten and heavy alloys",
            Self::RefractoryMetal => "Refractory metals",
            Self::Actinide => "Uranium and thorium",
            Self::PreciousMetal => "Precious metals",
            Self::OtherMetal => "Other metals",
            Self::HardMetal => "Cemented carbides",
            Self::Ceramic => "Ceramics",
            Self::Glass => "Glass",
            Self::Polymer => "Polymers",
            Self::Concrete => "Concrete and stone",
        }
    }

    /// The group of a key, in either spelling of a compound.
    pub fn of(key: &str) -> Option<Self> {
        let key = key.to_lowercase().replace(['-', ' '], "_");
        Self::ALL.into_iter().find(|group| group.key() == key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Files, commands and this list agree on every name.
    #[test]
    fn keys_are_those_of_files() {
        for group in MaterialGroup::ALL {
            let text = serde_json::to_string(&group).unwrap();
            assert_eq!(text, format!("\"{}\"", group.key()));
            assert_eq!(MaterialGroup::of(group.key()), Some(group));
        }
        assert_eq!(
            MaterialGroup::of("Refractory-Metal"),
            Some(MaterialGroup::RefractoryMetal)
        );
        assert_eq!(MaterialGroup::of("cheese"), None);
    }
}
