// A line is one octet of one channel: eight values of the vector that a texel's samples make.
#import octet

// What the values of a line are above a centre; 0 where they are masked.
fn deviation(line: vec4<u32>, centre: Octet) -> Octet {
    let x = unpack_octet(line);
    return Octet(
        select(x.low - centre.low, vec4(0.0), x.low < vec4(0.0)),
        select(x.high - centre.high, vec4(0.0), x.high < vec4(0.0)),
    );
}

// 1 where a value of a line is not masked.
fn valid(line: vec4<u32>) -> Octet {
    let x = unpack_octet(line);
    return Octet(select(vec4(0.0), vec4(1.0), x.low >= vec4(0.0)), select(vec4(0.0), vec4(1.0), x.high >= vec4(0.0)));
}
