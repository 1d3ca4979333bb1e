//! A quick case, and numbers that look drawn: what ordinary tests and the targets of `fuzz/` share.

/// A quick case.
pub const CASE: &str = r#"
title = "Copper on aluminium"
projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
target = { material = "aluminium-2024-t351", thickness = "25 mm" }
chain = { projectile_elements = 20, target_elements = 40 }
"#;

/// Numbers that look drawn, the same in every run.
pub struct Draw(pub u64);

impl Draw {
    pub fn below(&mut self, end: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % end
    }

    pub fn of<'a, T: ?Sized>(&mut self, words: &[&'a T]) -> &'a T {
        words[self.below(words.len())]
    }
}

/// Status of a response of HTTP, after those that come before it; 0 where there is none.
pub fn status(mut response: &[u8]) -> u32 {
    // To a client that has closed its half of the connection.
    while let Some(rest) = response.strip_prefix(b"HTTP/1.1 100 Continue\r\n\r\n") {
        response = rest;
    }
    let head = String::from_utf8_lossy(&response[..response.len().min(20)]);
    let status = head.split(' ').nth(1).and_then(|code| code.parse().ok());
    status.unwrap_or(0)
}
