//! Reduces a large drawing and encodes it as PNG.

use anyhow::Result;

/// Averages a drawing over squares of `square` pixels, as antialiasing, and encodes it as PNG. Three bytes
/// per pixel.
pub fn png(pixels: &[u8], width: u32, square: u32) -> Result<Vec<u8>> {
    let height = pixels.len() as u32 / 3 / width;
    encode(&average(pixels, width as usize, square as usize), width / square, height / square)
}

/// Replaces each square of pixels by its mean.
fn average(pixels: &[u8], width: usize, square: usize) -> Vec<u8> {
    let height = pixels.len() / 3 / width;
    let mut small = Vec::with_capacity(pixels.len() / square / square);
    for y in (0..height).step_by(square) {
        for x in (0..width).step_by(square) {
            for channel in 0..3 {
                let cells = (0..square * square).map(|cell| {
                    let (x, y) = (x + cell % square, y + cell / square);
                    usize::from(pixels[(y * width + x) * 3 + channel])
                });
                small.push((cells.sum::<usize>() / (square * square)) as u8);
            }
        }
    }
    small
}

fn encode(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    // At 200 dots per inch the figure is 11 by 10 inches.
    let per_metre = (200.0 / 0.0254_f64).round() as u32;
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn averaging_keeps_the_order_of_pixels() {
        let pixel = |value: u8| [value; 3];
        let pixels =
            [pixel(0), pixel(4), pixel(10), pixel(10), pixel(0), pixel(4), pixel(10), pixel(10)];
        assert_eq!(average(pixels.as_flattened(), 4, 2), [[2; 3], [10; 3]].as_flattened());
    }
}
