// The light of the picture, shared by people, floor and bodies: where the sun stands, and how it shades a surface.

/** Towards the sun, a unit vector: from the south-east, half way up. */
export const SUN = [0.451, -0.551, 0.702];

/** GLSL: shades a colour by a unit normal; `open` is the share of the sky that is not hidden, 0 to 1. */
export const LIGHT = `
const vec3 SUN = vec3(${SUN.join(", ")});
/* In a frame of axes of its own: towards the sky and the sun. */
vec3 litIn(vec3 colour, vec3 n, float open, vec3 up, vec3 towards) {
    float sky = 0.5 + 0.5 * dot(n, up), sun = max(0.0, dot(n, towards));
    vec3 light = mix(vec3(0.50, 0.47, 0.46), vec3(0.74, 0.77, 0.83), sky) * open + vec3(0.47, 0.44, 0.38) * sun * (0.4 + 0.6 * open);
    return colour * min(light, vec3(1.16));
}
vec3 lit(vec3 colour, vec3 n, float open) { return litIn(colour, n, open, vec3(0.0, 0.0, 1.0), SUN); }
`;
