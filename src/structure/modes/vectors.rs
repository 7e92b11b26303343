//! Products and sums of long vectors, the same bits for registers of any width. Several vectors at a time:
//! their sums do not wait for each other, and what they share is read once.

use multiversion::multiversion;

/// Vectors at a time.
const BLOCK: usize = 4;
/// Partial sums, and entries at a time.
const LANES: usize = 8;

/// a^T b.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let [product] = products([a], b);
    product
}

/// a^T b for each a.
pub fn dots(vectors: &[Vec<f64>], b: &[f64]) -> Vec<f64> {
    let (blocks, rest) = vectors.as_chunks::<BLOCK>();
    let blocks = blocks.iter().flat_map(|block| products(block.each_ref().map(Vec::as_slice), b));
    blocks.chain(rest.iter().map(|a| dot(a, b))).collect()
}

/// Adds `factor * vector` for each factor and vector, in their order.
pub fn add_all(target: &mut [f64], factors: &[f64], vectors: &[Vec<f64>]) {
    let (blocks, rest) = vectors.as_chunks::<BLOCK>();
    let (of_blocks, of_rest) = factors.as_chunks::<BLOCK>();
    for (factors, block) in of_blocks.iter().zip(blocks) {
        add_block(target, *factors, block.each_ref().map(Vec::as_slice));
    }
    for (factor, vector) in of_rest.iter().zip(rest) {
        add_one(target, *factor, vector);
    }
}

/// Each in eight partial sums.
#[multiversion(targets("x86_64+avx"))]
fn products<const N: usize>(vectors: [&[f64]; N], b: &[f64]) -> [f64; N] {
    let mut sums = [[0.0; LANES]; N];
    let (b, b_rest) = b.as_chunks::<LANES>();
    let vectors = vectors.map(<[f64]>::as_chunks::<LANES>);
    let chunks = vectors.map(|(chunks, _)| &chunks[..b.len()]);
    for (i, b) in b.iter().enumerate() {
        for k in 0..N {
            for lane in 0..LANES {
                sums[k][lane] += chunks[k][i][lane] * b[lane];
            }
        }
    }
    std::array::from_fn(|k| {
        let rest: f64 = vectors[k].1.iter().zip(b_rest).map(|(x, y)| x * y).sum();
        sums[k].iter().sum::<f64>() + rest
    })
}

#[multiversion(targets("x86_64+avx"))]
fn add_block(target: &mut [f64], [f, g, h, k]: [f64; BLOCK], [a, b, c, d]: [&[f64]; BLOCK]) {
    for ((((x, a), b), c), d) in target.iter_mut().zip(a).zip(b).zip(c).zip(d) {
        *x = *x + f * a + g * b + h * c + k * d;
    }
}

#[multiversion(targets("x86_64+avx"))]
fn add_one(target: &mut [f64], factor: f64, vector: &[f64]) {
    for (x, y) in target.iter_mut().zip(vector) {
        *x += factor * y;
    }
}

/// Multiplies a vector.
pub fn scale(vector: &mut [f64], factor: f64) {
    for x in vector {
        *x *= factor;
    }
}
