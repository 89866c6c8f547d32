//! Panels side by side with titles above and a legend below: sRGB bytes, row by row.

use super::{colours, lettering};

/// The paper, and what is written on it.
const PAPER: u8 = 255;
const INK: u8 = 32;
/// Dots of letters between things.
const GAP: usize = 4;
/// Dots that the legend's bar is high.
const BAR: usize = 8;
/// A dot is this share of a panel's height: text of a thirtieth of it.
const DOT_SHARE: usize = 210;

/// What the colours of the last panel mean.
pub(super) struct Legend {
    /// The difference at the ends of the bar.
    pub(super) range: f64,
}

/// A picture made of pictures.
pub(super) struct Sheet {
    pub(super) size: (u32, u32),
    pub(super) bytes: Vec<u8>,
    /// Pixels along a dot of a letter.
    dot: usize,
}

impl Sheet {
    /// Puts panels of one size, each with its title, next to each other; the legend is that of the last.
    pub(super) fn of(size: (u32, u32), panels: &[(&str, Vec<u8>)], legend: &Legend) -> Self {
        let (width, height) = (size.0 as usize, size.1 as usize);
        let dot = (height / DOT_SHARE).max(1);
        let title = (lettering::HEIGHT + 2 * GAP) * dot;
        let foot = (BAR + lettering::HEIGHT + 3 * GAP) * dot;
        let step = width + GAP * dot;
        let whole = (step * panels.len() - GAP * dot, title + height + foot);
        let bytes = vec![PAPER; 3 * whole.0 * whole.1];
        let mut sheet = Self { size: (whole.0 as u32, whole.1 as u32), bytes, dot };
        for (place, (name, pixels)) in panels.iter().enumerate() {
            let left = place * step;
            sheet.text(name, left, GAP * dot);
            for (down, row) in pixels.chunks_exact(3 * width).enumerate() {
                let start = 3 * ((title + down) * whole.0 + left);
                sheet.bytes[start..start + row.len()].copy_from_slice(row);
            }
        }
        let left = whole.0 - width;
        sheet.bar(left, width, title + height + GAP * dot);
        let below = title + height + (2 * GAP + BAR) * dot;
        let [least, most] = ["-", "+"].map(|sign| format!("{sign}{}", percent(legend.range)));
        let middle = |text: &str, share: f64| {
            let room = width.saturating_sub(lettering::width(text) * dot) as f64;
            left + (share * room) as usize
        };
        sheet.text(&least, middle(&least, 0.0), below);
        sheet.text("0", middle("0", 0.5), below);
        sheet.text(&most, middle(&most, 1.0), below);
        sheet
    }

    /// The colours from one end to the other.
    fn bar(&mut self, left: usize, width: usize, top: usize) {
        for right in 0..width {
            let share = 2.0 * (right as f64 + 0.5) / width as f64 - 1.0;
            let colour = colours::colour(share).map(|c| c.round() as u8);
            for down in 0..BAR * self.dot {
                self.pixel(left + right, top + down, colour);
            }
        }
    }

    fn text(&mut self, text: &str, left: usize, top: usize) {
        let dot = self.dot;
        lettering::dots(text, |right, down| {
            for i in 0..dot * dot {
                let (x, y) = (right * dot + i % dot, down * dot + i / dot);
                self.pixel(left + x, top + y, [INK; 3]);
            }
        });
    }

    /// What lies beside the sheet is cut off.
    fn pixel(&mut self, x: usize, y: usize, colour: [u8; 3]) {
        let (width, height) = (self.size.0 as usize, self.size.1 as usize);
        if x < width && y < height {
            let start = 3 * (y * width + x);
            self.bytes[start..start + 3].copy_from_slice(&colour);
        }
    }
}

/// A share in the letters that there are.
fn percent(share: f64) -> String {
    // Ranges have few digits; a small one needs its places.
    let percent = 100.0 * share;
    let places = (2.0 - percent.log10().floor()).clamp(0.0, 9.0) as usize;
    let text = format!("{percent:.places$}");
    let short =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    format!("{short}%")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        for (share, text) in [
            (0.1, "10%"),
            (2.0, "200%"),
            (0.005, "0.5%"),
            (0.02, "2%"),
            (0.125, "12.5%"),
            (1e-6, "0.0001%"),
        ] {
            assert_eq!(percent(share), text);
        }
    }
}
