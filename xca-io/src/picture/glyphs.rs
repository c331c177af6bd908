//! The shapes of the letters.
//!
//! A glyph is a list of strokes on a grid: the base line at 4, small letters up to 14, capitals up to 18, descenders
//! down to 0. A stroke begins with `-` (straight lines from point to point) or `~` (a smooth curve, to which the points
//! are the control points of a quadratic B-spline, closed where the last point is the first); then come the points, two
//! characters each, x and y, in base 36. A single point is a dot.

/// The strokes of a character as lists of points, in grid units, y upwards.
pub(super) fn strokes_of(c: char) -> Vec<Vec<[f32; 2]>> {
    code(c).split(' ').map(stroke).collect()
}

fn stroke(code: &str) -> Vec<[f32; 2]> {
    let digits: Vec<f32> = code.chars().filter_map(|c| c.to_digit(36)).map(|d| d as f32).collect();
    let points: Vec<[f32; 2]> = digits.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
    if code.starts_with('~') { smooth(&points) } else { points }
}

/// The quadratic B-spline of the control points, as a line of short pieces.
fn smooth(control: &[[f32; 2]]) -> Vec<[f32; 2]> {
    const PIECES: usize = 6;
    let middle = |a: [f32; 2], b: [f32; 2]| [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    let last = control.len() - 1;
    let closed = last > 2 && control[0] == control[last];
    // Triples of start, control point and end, each a parabola.
    let parabolas: Vec<[[f32; 2]; 3]> = if closed {
        (0..last)
            .map(|i| {
                let (before, after) = (control[(i + last - 1) % last], control[(i + 1) % last]);
                [middle(before, control[i]), control[i], middle(control[i], after)]
            })
            .collect()
    } else {
        (1..last)
            .map(|i| {
                let start = if i == 1 { control[0] } else { middle(control[i - 1], control[i]) };
                let end = if i + 1 == last { control[last] } else { middle(control[i], control[i + 1]) };
                [start, control[i], end]
            })
            .collect()
    };
    let mut line: Vec<[f32; 2]> = parabolas.first().map(|parabola| parabola[0]).into_iter().collect();
    for [a, b, c] in parabolas {
        line.extend((1..=PIECES).map(|k| {
            let t = k as f32 / PIECES as f32;
            let (u, v, w) = ((1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t);
            [u * a[0] + v * b[0] + w * c[0], u * a[1] + v * b[1] + w * c[1]]
        }));
    }
    line
}

fn code(c: char) -> &'static str {
    match c {
        '0' => "~04949i0i04",
        '1' => "-1f5i54",
        '2' => "~0e0i9i9b04 -0494",
        '3' => "~0f0i9i9b3b ~3baba40407",
        '4' => "-747i08a8",
        '5' => "-8i1i1b ~1b4d9d940407",
        '6' => "~04949c0c04 ~8i0i08",
        '7' => "-0i9i34",
        '8' => "~04949b0b04 ~1b8b8i1i1b",
        '9' => "~0i9i9a0a0i ~14949e",
        'A' => "-045ia4 -2989",
        'B' => "-040i ~0i5i9i9b5b0b ~0b5baba45404",
        'C' => "~afai0i04a4a7",
        'D' => "-040i ~0i4iaia44404",
        'E' => "-9i0i0494 -0b7b",
        'F' => "-9i0i04 -0b7b",
        'G' => "~afai0i04a4ab -ab6b",
        'H' => "-040i -a4ai -0bab",
        'I' => "-040i",
        'J' => "~6i68640407",
        'K' => "-040i -9i09 -3ca4",
        'L' => "-0i0494",
        'M' => "-040i68cic4",
        'N' => "-040ia4ai",
        'O' => "~04b4bi0i04",
        'P' => "-040i ~0i5iaiaa5a0a",
        'Q' => "~04b4bi0i04 -67b3",
        'R' => "-040i ~0i5iaiaa5a0a -4aa4",
        'S' => "~9f9i0i0b9b940407",
        'T' => "-0iai -5i54",
        'U' => "~0i0904a4a9ai",
        'V' => "-0i54ai",
        'W' => "-0i346f94ci",
        'X' => "-04ai -0ia4",
        'Y' => "-0i5b -ai5b54",
        'Z' => "-0iai04a4",
        'a' => "~04848e0e04 -8e84",
        'b' => "-0i04 ~04848e0e04",
        'c' => "~8c8e0e048486",
        'd' => "-8i84 ~04848e0e04",
        'e' => "-0989 ~898e0e048486",
        'f' => "~6i2i2d24 -0e5e",
        'g' => "~04848e0e04 ~8e84800002",
        'h' => "-0i04 ~090e8e8984",
        'i' => "-0e04 -0i",
        'j' => "~3e343000 -3i",
        'k' => "-0i04 -7e08 -2a74",
        'l' => "-0i04",
        'm' => "-0e04 ~090e7e7974 ~797eeee9e4",
        'n' => "-0e04 ~090e8e8984",
        'o' => "~04949e0e04",
        'p' => "-0e00 ~04848e0e04",
        'q' => "-8e80 ~04848e0e04",
        'r' => "-0e04 ~090e5e",
        's' => "~7c7e0e0979740406",
        't' => "~2h282464 -0e6e",
        'u' => "~0e090484898e -8e84",
        'v' => "-0e448e",
        'w' => "-0e346c94ce",
        'x' => "-048e -0e84",
        'y' => "-0e44 -8e20",
        'z' => "-0e8e0484",
        'µ' | 'μ' => "-0e00 ~090484898e -8e84",
        '.' => "-04",
        ',' => "-1402",
        ':' => "-04 -0c",
        ';' => "-1402 -1c",
        '-' | '−' | '–' => "-0a6a",
        '+' => "-0a8a -464e",
        '=' => "-0888 -0c8c",
        '*' => "-096d -0d69 -3f37",
        '×' => "-068e -0e86",
        '·' => "-0a",
        '/' => "-037i",
        '\\' => "-0i73",
        '|' => "-0k00",
        '(' => "~4j0e0842",
        ')' => "~0j4e4802",
        '[' => "-4j0j0242",
        ']' => "-0j4j4202",
        '{' => "~4j1j2b0b ~0b2b1242",
        '}' => "~0j3j2b4b ~4b2b3202",
        '<' => "-8e0a86",
        '>' => "-0e8a06",
        '%' => "~0d4d4i0i0d ~64a4a96964 -149i",
        '_' => "-0282",
        '!' => "-0i09 -04",
        '?' => "~0f0i7i7c3c38 -34",
        '\'' => "-0i0e",
        '"' => "-0i0e -3i3e",
        '`' => "-0i3f",
        '#' => "-143i -749i -0c9c -0898",
        '&' => "~a41e1i7i7d0a0484a9",
        '$' => "~9f9i0i0b9b940407 -4k42",
        '@' => "~87878c4c4787 ~8c89a6c8ci0i04b4",
        '~' => "~092d678b",
        '°' => "~0e4e4i0i0e",
        _ => "-040i9i9404",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_stroke_has_points_on_the_grid() {
        for c in (33..127_u8).map(char::from).chain(['×', '·', 'µ', '°', '\u{1F600}']) {
            for line in strokes_of(c) {
                assert!(!line.is_empty(), "{c}");
                for [x, y] in line {
                    assert!((0.0..=14.0).contains(&x) && (0.0..=20.0).contains(&y), "{c}: {x} {y}");
                }
            }
        }
    }

    #[test]
    fn a_closed_curve_touches_the_middle_of_its_edges_and_ends_where_it_began() {
        let line = stroke("~04848e0e04");
        assert_eq!(line[0], line[line.len() - 1]);
        for touched in [[4.0, 4.0], [8.0, 9.0], [4.0, 14.0], [0.0, 9.0]] {
            assert!(line.contains(&touched), "{touched:?}");
        }
    }
}
