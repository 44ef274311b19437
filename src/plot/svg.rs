//! A picture as an SVG document.

use super::axis::Mapping;
use super::layout::{Frame, TOTAL_WIDTH};
use super::png::{base64, map_png, palette};
use super::{Layer, Panel, Plot};
use std::fmt::Write as _;

/// Colours of text, of less important text and of grid lines.
const INK: &str = "#1c2430";
const QUIET: &str = "#5b6675";
const GRID: &str = "#e6e9ee";

/// Colours of curves, which differ in lightness as well as in hue.
const COLOURS: [&str; 6] = ["#1d4f91", "#c06a00", "#7a4fa3", "#a3262a", "#1f7a4d", "#4a5a6a"];
/// Dashes of curves.
const DASHES: [&str; 6] = ["", "7 3", "2 3", "9 3 2 3", "12 4", "4 2"];

/// A number of an SVG attribute: one decimal, no trailing zero.
fn number(value: f64) -> String {
    let tenths = (value * 10.0).round();
    let text = format!("{:.1}", if tenths == 0.0 { 0.0 } else { tenths / 10.0 });
    text.strip_suffix(".0").map_or(text.clone(), str::to_owned)
}

/// A text with the characters escaped that have a meaning in XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Width of a text at 12 px, roughly.
fn text_width(text: &str) -> f64 {
    text.chars().map(|c| if "ijlt.,:;|()' ".contains(c) { 3.6 } else { 6.7 }).sum()
}

impl Plot {
    /// The picture as a standalone SVG document.
    pub fn to_svg(&self) -> String {
        let id = escaped(&self.id);
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" aria-labelledby=\"{id}-title {id}-description\" font-family=\"system-ui, 'Segoe UI', 'DejaVu Sans', sans-serif\" font-size=\"12\" fill=\"{INK}\">\n<title id=\"{id}-title\">{}</title>\n<desc id=\"{id}-description\">{}</desc>\n<rect width=\"{w}\" height=\"{h}\" fill=\"#fff\"/>\n<text x=\"16\" y=\"28\" font-size=\"16\" font-weight=\"600\">{}</text>\n",
            escaped(&self.title),
            escaped(&self.description),
            escaped(&self.title),
            w = number(TOTAL_WIDTH),
            h = number(self.height()),
        );
        for (k, panel) in self.panels.iter().enumerate() {
            panel.draw(&mut out, &self.frame(k), &format!("{id}-{k}"));
        }
        out.push_str("</svg>\n");
        out
    }
}

impl Panel {
    fn draw(&self, out: &mut String, frame: &Frame, id: &str) {
        let (has_map, [x, y]) = (self.has_map(), self.mappings(frame));
        let clip = format!("{id}-clip");
        let _ = writeln!(
            out,
            "<clipPath id=\"{clip}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>",
            number(frame.left),
            number(frame.top),
            number(frame.width),
            number(frame.height)
        );
        self.draw_title(out, frame);
        self.draw_axes(out, frame, x, y, has_map);
        let _ = writeln!(out, "<g clip-path=\"url(#{clip})\">");
        for layer in &self.layers {
            draw_layer(out, layer, x, y);
        }
        out.push_str("</g>\n");
        for layer in &self.layers {
            match layer {
                Layer::Rule { name, vertical, at, left } => {
                    draw_rule_name(out, name, (*vertical, *at, *left), x, y);
                }
                Layer::Map { name, range, middle, signed_log, .. } => {
                    draw_colour_bar(out, name, *range, (middle.is_some(), *signed_log), frame, id);
                }
                _ => {}
            }
        }
        self.draw_legend(out, frame);
    }

    fn draw_title(&self, out: &mut String, frame: &Frame) {
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" font-weight=\"600\" font-size=\"13\">{}</text>",
            number(frame.left),
            number(frame.top - 26.0),
            escaped(&self.title)
        );
    }

    fn draw_axes(&self, out: &mut String, frame: &Frame, x: Mapping, y: Mapping, has_map: bool) {
        let bottom = frame.top + frame.height;
        let right = frame.left + frame.width;
        let y_ticks = y.ticks((frame.height / 34.0) as usize);
        let widest = x.ticks(8).iter().map(|t| text_width(&t.1)).fold(24.0, f64::max);
        let x_ticks = x.ticks((frame.width / (widest + 22.0)) as usize);
        let _ = writeln!(out, "<g fill=\"{QUIET}\" stroke-width=\"1\">");
        for (value, label) in &y_ticks {
            let at = number(y.at(*value));
            let (from, to, stroke) =
                if has_map { (frame.left - 4.0, frame.left, QUIET) } else { (frame.left, right, GRID) };
            let _ = writeln!(
                out,
                "<path d=\"M{} {at}H{}\" stroke=\"{stroke}\"/><text x=\"{}\" y=\"{}\" text-anchor=\"end\">{label}</text>",
                number(from),
                number(to),
                number(frame.left - 8.0),
                number(y.at(*value) + 4.0)
            );
        }
        for (value, label) in &x_ticks {
            let at = number(x.at(*value));
            let _ = writeln!(
                out,
                "<path d=\"M{at} {}v4\" stroke=\"{QUIET}\"/><text x=\"{at}\" y=\"{}\" text-anchor=\"middle\">{label}</text>",
                number(bottom),
                number(bottom + 18.0)
            );
        }
        let _ = writeln!(
            out,
            "<path d=\"M{} {}H{}\" stroke=\"{QUIET}\"/>",
            number(frame.left),
            number(bottom),
            number(right)
        );
        let (middle_x, middle_y) = (frame.left + frame.width / 2.0, frame.top + frame.height / 2.0);
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n<text transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n</g>",
            number(middle_x),
            number(bottom + frame.bottom - 10.0),
            escaped(&self.x.label),
            number(frame.left - 46.0),
            number(middle_y),
            escaped(&self.y.label)
        );
    }

    /// Names of curves, bands and points in a row above the axes.
    fn draw_legend(&self, out: &mut String, frame: &Frame) {
        let mut at = frame.left;
        let y = frame.top - 9.0;
        for layer in &self.layers {
            let (name, style, swatch) = match layer {
                Layer::Curve { name, style, .. } => {
                    let d = format!("M{} {}h22", number(at), number(y - 4.0));
                    (name, *style, format!("<path d=\"{d}\" {}/>", stroke(*style)))
                }
                Layer::Band { name, style, .. } => (
                    name,
                    *style,
                    format!(
                        "<rect x=\"{}\" y=\"{}\" width=\"22\" height=\"10\" fill=\"{}\" fill-opacity=\"0.18\"/>",
                        number(at),
                        number(y - 9.0),
                        COLOURS[style % COLOURS.len()]
                    ),
                ),
                Layer::Points { name, style, .. } => (name, *style, marker(*style, at + 11.0, y - 4.0)),
                Layer::Rule { .. } | Layer::Map { .. } => continue,
            };
            // A name that would reach into the next panel is left out; the read-out still gives it.
            let fits = at + 27.0 + text_width(name) <= frame.left + frame.width + frame.right;
            if name.is_empty() || !fits {
                continue;
            }
            let _ = writeln!(
                out,
                "{swatch}<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>",
                number(at + 27.0),
                number(y),
                COLOURS[style % COLOURS.len()],
                escaped(name)
            );
            at += 27.0 + text_width(name) + 14.0;
        }
    }
}

/// The attributes of a curve's line.
fn stroke(style: usize) -> String {
    let (colour, dash) = (COLOURS[style % COLOURS.len()], DASHES[style % DASHES.len()]);
    let dashes = if dash.is_empty() { String::new() } else { format!(" stroke-dasharray=\"{dash}\"") };
    format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\" stroke-linejoin=\"round\"{dashes}")
}

/// The symbol of a point: disc, square, triangle, diamond, by style.
fn marker(style: usize, x: f64, y: f64) -> String {
    let colour = COLOURS[style % COLOURS.len()];
    let d = match style % 4 {
        0 => format!("M{} {}a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0 -7 0z", number(x - 3.5), number(y)),
        1 => format!("M{} {}h7v7h-7z", number(x - 3.5), number(y - 3.5)),
        2 => format!("M{} {}l4.5 8h-9z", number(x), number(y - 5.0)),
        _ => format!("M{} {}l4.5 4.5l-4.5 4.5l-4.5 -4.5z", number(x), number(y - 4.5)),
    };
    format!("<path d=\"{d}\" fill=\"{colour}\" stroke=\"#fff\" stroke-width=\"0.8\"/>")
}

/// `M… L…` through the points; a point that is not finite breaks the curve.
fn path(points: impl Iterator<Item = (f64, f64)>, x: Mapping, y: Mapping) -> String {
    let mut d = String::new();
    let mut connected = false;
    // Points far outside the axes are clipped, and some viewers fail at huge coordinates.
    let bounded = |v: f64, m: Mapping| m.at(v).clamp(-4000.0, 4000.0);
    for (px, py) in points {
        if px.is_finite() && py.is_finite() {
            let command = if connected { 'L' } else { 'M' };
            let _ = write!(d, "{command}{} {}", number(bounded(px, x)), number(bounded(py, y)));
        }
        connected = px.is_finite() && py.is_finite();
    }
    d
}

fn draw_layer(out: &mut String, layer: &Layer, x: Mapping, y: Mapping) {
    match layer {
        Layer::Curve { style, x: xs, y: ys, .. } => {
            let d = path(xs.iter().copied().zip(ys.iter().copied()), x, y);
            let _ = writeln!(out, "<path d=\"{d}\" {}/>", stroke(*style));
        }
        Layer::Band { style, x: xs, low, high, .. } => {
            let forth = xs.iter().copied().zip(high.iter().copied());
            let back = xs.iter().copied().zip(low.iter().copied()).rev();
            let known = forth.chain(back).filter(|p| p.1.is_finite());
            let d = path(known, x, y);
            let colour = COLOURS[style % COLOURS.len()];
            let _ = writeln!(out, "<path d=\"{d}z\" fill=\"{colour}\" fill-opacity=\"0.18\"/>");
        }
        Layer::Points { style, x: xs, y: ys, error, .. } => {
            let colour = COLOURS[style % COLOURS.len()];
            for (k, (&px, &py)) in xs.iter().zip(ys).enumerate() {
                if !(py.is_finite() && x.holds(px)) {
                    continue;
                }
                if let Some(&e) = error.get(k).filter(|e| e.is_finite() && **e > 0.0) {
                    let _ = writeln!(
                        out,
                        "<path d=\"M{} {}V{}\" stroke=\"{colour}\" stroke-width=\"1.3\"/>",
                        number(x.at(px)),
                        number(y.at(py - e)),
                        number(y.at(py + e))
                    );
                }
                let _ = writeln!(out, "{}", marker(*style, x.at(px), y.at(py)));
            }
        }
        Layer::Rule { vertical, at, .. } => {
            let d = if *vertical {
                format!("M{} {}V{}", number(x.at(*at)), number(y.start), number(y.end))
            } else {
                format!("M{} {}H{}", number(x.start), number(y.at(*at)), number(x.end))
            };
            let _ = writeln!(out, "<path d=\"{d}\" stroke=\"{QUIET}\" stroke-dasharray=\"4 3\"/>");
        }
        Layer::Map { width, x: across, y: up, values, range, middle, signed_log, .. } => {
            let scale =
                Mapping { low: range.0, high: range.1, start: 0.0, end: 1.0, signed_log: *signed_log };
            let png = map_png(*width, values, scale, middle.is_some());
            let _ = writeln!(
                out,
                "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" image-rendering=\"pixelated\" href=\"data:image/png;base64,{}\"/>",
                number(x.at(across.0)),
                number(y.at(up.1)),
                number(x.at(across.1) - x.at(across.0)),
                number(y.at(up.0) - y.at(up.1)),
                base64(&png)
            );
        }
    }
}

fn draw_rule_name(
    out: &mut String,
    name: &str,
    (vertical, at, left): (bool, f64, bool),
    x: Mapping,
    y: Mapping,
) {
    if name.is_empty() || !(if vertical { x } else { y }).holds(at) {
        return;
    }
    let name = escaped(name);
    let halo = "stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\"";
    if vertical {
        let place = x.at(at);
        let (shift, anchor) = if place > 0.5 * (x.start + x.end) { (-5.0, "end") } else { (5.0, "start") };
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"{QUIET}\" {halo}>{name}</text>",
            number(place + shift),
            number(y.end + 12.0)
        );
    } else {
        let (place, anchor) = if left { (x.start + 4.0, "start") } else { (x.end - 4.0, "end") };
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" text-anchor=\"{anchor}\" fill=\"{QUIET}\" {halo}>{name}</text>",
            number(place),
            number(y.at(at) - 4.0)
        );
    }
}

fn draw_colour_bar(
    out: &mut String,
    name: &str,
    range: (f64, f64),
    (diverging, signed_log): (bool, bool),
    frame: &Frame,
    id: &str,
) {
    let colours = palette(diverging);
    let x = frame.left + frame.width + 12.0;
    let _ = write!(out, "<linearGradient id=\"{id}-bar\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">");
    for k in 0..=16 {
        let [r, g, b] = colours[k * 254 / 16];
        let _ = write!(out, "<stop offset=\"{}\" stop-color=\"#{r:02x}{g:02x}{b:02x}\"/>", k as f64 / 16.0);
    }
    let _ = writeln!(
        out,
        "</linearGradient><rect x=\"{}\" y=\"{}\" width=\"10\" height=\"{}\" fill=\"url(#{id}-bar)\"/>",
        number(x),
        number(frame.top),
        number(frame.height)
    );
    let bottom = frame.top + frame.height;
    let up = Mapping { low: range.0, high: range.1, start: bottom, end: frame.top, signed_log };
    for (value, label) in up.ticks(5) {
        let _ = writeln!(
            out,
            "<text x=\"{}\" y=\"{}\" fill=\"{QUIET}\" font-size=\"11\">{label}</text>",
            number(x + 14.0),
            number(up.at(value) + 4.0)
        );
    }
    let _ = writeln!(
        out,
        "<text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"{QUIET}\" font-size=\"11\">{}</text>",
        number(frame.left + frame.width + frame.right - 6.0),
        number(frame.top - 9.0),
        escaped(name)
    );
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_is_broken_where_there_is_no_value() {
        let m = Mapping { low: 0.0, high: 3.0, start: 0.0, end: 30.0, signed_log: false };
        let d = path([(0.0, 0.0), (1.0, f64::NAN), (2.0, 1.0), (3.0, 2.0)].into_iter(), m, m);
        assert_eq!(d, "M0 0M20 10L30 20");
    }
}
