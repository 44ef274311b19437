//! A map as a PNG image, one pixel for each cell, to stand within an SVG document.

use super::axis::Mapping;
use super::colour::{Ground, Quantity, Rgb, Scale};

/// The 255 colours of a map from the lowest value to the highest. (Entry 0 of the image's palette, before them, is
/// for blank cells.)
pub(super) fn palette(diverging: bool) -> Vec<Rgb> {
    let quantity = if diverging { Quantity::Difference } else { Quantity::Speed };
    let scale = Scale::new(quantity, Ground::Light, 1.0);
    let colours = scale.colours();
    (0..255).map(|i| colours[i * (colours.len() - 1) / 254]).collect()
}

/// The image: one pixel for each cell, the row of the largest y first. `scale` maps the values to 0 … 1.
pub(super) fn map_png(width: usize, values: &[f64], scale: Mapping, diverging: bool) -> Vec<u8> {
    let height = values.len() / width.max(1);
    let mut pixels = Vec::with_capacity(height * (width + 1));
    for row in (0..height).rev() {
        pixels.push(0); // no filter
        for &value in &values[row * width..][..width] {
            let place = scale.at(value).clamp(0.0, 1.0);
            // Entry 0 is the blank, for NaN.
            pixels.push(if place.is_nan() { 0 } else { 1 + (place * 254.0).round() as u8 });
        }
    }
    let mut colours = vec![255, 255, 255];
    colours.extend(palette(diverging).into_iter().flatten());
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut head = Vec::new();
    head.extend((width as u32).to_be_bytes());
    head.extend((height as u32).to_be_bytes());
    head.extend([8, 3, 0, 0, 0]); // 8 bits, palette
    chunk(&mut png, *b"IHDR", &head);
    chunk(&mut png, *b"PLTE", &colours);
    chunk(&mut png, *b"IDAT", &zlib_stored(&pixels));
    chunk(&mut png, *b"IEND", &[]);
    png
}

/// A PNG chunk: length, name, data and their CRC-32.
fn chunk(png: &mut Vec<u8>, name: [u8; 4], data: &[u8]) {
    png.extend((data.len() as u32).to_be_bytes());
    let start = png.len();
    png.extend(name);
    png.extend(data);
    let crc = !png[start..].iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { (c >> 1) ^ 0xedb8_8320 } else { c >> 1 })
    });
    png.extend(crc.to_be_bytes());
}

/// A zlib stream of uncompressed blocks: the maps are small, and the code of a compressor would be larger than the
/// bytes that it saves.
fn zlib_stored(data: &[u8]) -> Vec<u8> {
    let mut out = vec![0x78, 0x01];
    let mut blocks = data.chunks(65_535).peekable();
    while let Some(block) = blocks.next() {
        out.push(u8::from(blocks.peek().is_none()));
        let length = block.len() as u16;
        out.extend(length.to_le_bytes());
        out.extend((!length).to_le_bytes());
        out.extend(block);
    }
    let (a, b) = data.iter().fold((1_u32, 0_u32), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65_521;
        (a, (b + a) % 65_521)
    });
    out.extend(((b << 16) | a).to_be_bytes());
    out
}

/// Base64 with padding (RFC 4648).
pub(super) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let byte = |i: usize| u32::from(part.get(i).copied().unwrap_or(0));
        let bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for i in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * i)) as usize & 63] as char;
            out.push(if i <= part.len() { digit } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_standard() {
        for (text, code) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")]
        {
            assert_eq!(base64(text.as_bytes()), code);
        }
    }

    /// Checksums of the standards: CRC-32 of "IEND" and Adler-32 of "Wikipedia".
    #[test]
    fn checksums_are_right() {
        let mut png = Vec::new();
        chunk(&mut png, *b"IEND", &[]);
        assert_eq!(png, [0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xae, 0x42, 0x60, 0x82]);
        assert_eq!(zlib_stored(b"Wikipedia")[16..], [0x11, 0xe6, 0x03, 0x98]);
    }

    #[test]
    fn a_map_has_one_pixel_a_cell_with_the_largest_y_first() {
        let unit = Mapping { low: 0.0, high: 1.0, start: 0.0, end: 1.0, signed_log: false };
        let png = map_png(2, &[0.0, 0.5, 1.0, f64::NAN], unit, false);
        let start = png.windows(4).position(|w| w == b"IDAT").unwrap() + 4 + 2 + 5;
        assert_eq!(png[start..start + 6], [0, 255, 0, 0, 1, 128]);
    }
}
