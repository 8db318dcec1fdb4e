// An octet: eight consecutive samples of one texel and channel, as halves in four words.
struct Octet {
    low: vec4<f32>,
    high: vec4<f32>,
}

fn unpack_octet(words: vec4<u32>) -> Octet {
    return Octet(
        vec4(unpack2x16float(words.x), unpack2x16float(words.y)),
        vec4(unpack2x16float(words.z), unpack2x16float(words.w)),
    );
}

fn pack_octet(octet: Octet) -> vec4<u32> {
    return vec4(
        pack2x16float(octet.low.xy),
        pack2x16float(octet.low.zw),
        pack2x16float(octet.high.xy),
        pack2x16float(octet.high.zw),
    );
}
