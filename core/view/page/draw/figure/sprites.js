// Shaders of people far away: a point each, with the atlas's picture of their pose from where the eye is, coloured
// and lit as the meshes are.
import { LIGHT, SUN } from "../light.js";
import { HALF, MIDDLE, RISES, WAYS } from "./atlas.js";
import { DECODE, VIEW } from "./decode.js";
import { LOOKS } from "./looks.js";
import { AXES, FADE, KEEP } from "./mesh.js";

export const SPRITE_VERTEX = DECODE + LOOKS + AXES + KEEP + VIEW + `
uniform sampler2D boxes;    // what the figure covers of each cell, in halves of it
uniform vec4 cells;         // columns and rows of the atlas, phases of a gait, poses
uniform float texels;       // of a cell, up
flat out mat2 across;       // from the point's pixels to the figure's box
flat out vec4 box;          // middle and half of the box in the atlas
flat out vec3 sun, sky, top, sleeve, hips, leg, skin, hair, shoe;
flat out vec4 bag;          // its colour, and 1 if it is worn
flat out float blur;
const vec3 SUN = vec3(${SUN.join(", ")});

/* Row of the atlas: standing, a phase of one of three gaits, or an action; then those with robes. */
float rowOf(Person p, Outfit o, bool mirrored) {
    float phase = floor(fract(p.phase + (mirrored ? 0.5 : 0.0)) * cells.z), row;
    if (p.lies) row = cells.w - 1.0;
    else if (p.action > 0u) row = 3.0 * cells.z + float(p.action);
    else row = p.gait < 0.5 ? 0.0 : 1.0 + phase + cells.z * (p.gait < 2.5 ? 0.0 : p.gait < 4.5 ? 1.0 : 2.0);
    return row + (o.robe || o.skirt ? cells.w : 0.0);
}

void main() {
    Person p = decode();
    gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
    gl_PointSize = 1.0;
    keep(p.at, p.base);
    if (!p.here || kept.y <= 0.0) return;
    Outfit o = dress(p.look, p.clothes, p.colour, p.plays, classes);
    vec3 front, left, up;
    axesOf(p, front, left, up);
    vec3 middle = originOf(p, up) + ${MIDDLE} * p.size.z * up, view = towardsEye(middle);
    vec3 own = vec3(dot(view, front), dot(view, left), dot(view, up));
    float yaw = atan(own.y, own.x), rise = asin(clamp(own.z, -1.0, 1.0)), side = yaw < 0.0 ? -1.0 : 1.0;
    float level = clamp(floor(p.lies ? rise * 12.0 / TURN + 2.5 : rise * 16.0 / TURN + 0.5), 0.0, ${RISES - 1}.0);
    vec2 cell = vec2(min(floor(abs(yaw) * ${2 * WAYS}.0 / TURN), ${WAYS - 1}.0) + ${WAYS}.0 * level, rowOf(p, o, side < 0.0));
    vec4 covered = texelFetch(boxes, ivec2(cell), 0);
    vec2 half_box = 0.5 * (covered.zw - covered.xy), at = 0.5 * (covered.zw + covered.xy);
    box = vec4(cell + 0.5 + 0.5 * at, 0.5 * half_box) / cells.xyxy;
    // The box's axes in the world, scaled as the body is.
    vec3 right = vec3(-sin(yaw), cos(yaw), 0.0), high = cross(own, right);
    vec3 scale = vec3(mix(p.size.x, p.size.z, 0.5 * (1.0 - max(own.z, 0.0))), p.size.y, p.size.z);
    right *= ${HALF[0]} * scale;
    high *= ${HALF[1]} * scale;
    vec3 wide = front * right.x + left * right.y + up * right.z, tall = front * high.x + left * high.y + up * high.z;
    gl_Position = projectionMatrix * viewMatrix * vec4(middle + wide * at.x * side + tall * at.y, 1.0);
    float pixels = metre / gl_Position.w; // of a metre
    vec2 a = pixels * half_box.x * (viewMatrix * vec4(wide, 0.0)).xy, b = pixels * half_box.y * (viewMatrix * vec4(tall, 0.0)).xy;
    float thin = max(1.0, 0.9 / max(length(a), 0.05)); // not thinner than can be seen
    a *= thin;
    b *= max(1.0, 1.2 / max(length(b), 0.05));
    gl_PointSize = 2.0 * max(abs(a.x) + abs(b.x), abs(a.y) + abs(b.y));
    across = inverse(mat2(a * side, b)) * gl_PointSize;
    blur = clamp(log2(0.5 * texels / (${HALF[1]} * p.size.z * pixels)), 0.0, 3.0);
    sun = vec3(dot(SUN, front), dot(SUN, left) * side, dot(SUN, up));
    sky = vec3(front.z, left.z * side, up.z);
    top = o.top, sleeve = o.sleeve, hips = o.hips, leg = o.skirt ? o.skin : o.leg, skin = o.skin, shoe = o.shoe;
    hair = o.hat ? o.bag : o.hair; // a hat has the colour of bags, and covers the hair
    bag = vec4(o.bag, o.bagged);
}`;

export const SPRITE_FRAGMENT = `
precision highp float;
precision highp int;
uniform sampler2D atlasClothes, atlasBody, atlasSurface;
flat in mat2 across;
flat in vec4 box;
flat in vec3 sun, sky, top, sleeve, hips, leg, skin, hair, shoe;
flat in vec4 bag;
flat in float blur;
out vec4 drawn;
` + FADE + LIGHT + `
void main() {
    vec2 at = across * (vec2(gl_PointCoord.x, 1.0 - gl_PointCoord.y) - 0.5);
    if (max(abs(at.x), abs(at.y)) > 1.0) discard;
    vec2 spot = box.xy + at * box.zw;
    vec4 body = textureLod(atlasBody, spot, blur);
    if (body.a < 0.45) discard;
    fade();
    vec4 clothes = textureLod(atlasClothes, spot, blur), surface = textureLod(atlasSurface, spot, blur);
    vec3 n = normalize(2.0 * surface.rgb - body.a + vec3(0.0, 0.0, 1e-3));
    vec3 back = mix(top, bag.rgb, bag.a * smoothstep(0.55, 0.9, -n.x)); // a bag covers the middle of the back
    vec3 colour = clothes.r * back + clothes.g * sleeve + clothes.b * hips + clothes.a * leg + body.r * skin + body.g * hair + body.b * shoe;
    drawn = vec4(litIn(colour / body.a, n, surface.a / body.a, sky, sun), 1.0);
}`;
