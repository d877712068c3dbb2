// The new sun's disc, in the photo's scene-linear unit: limb-darkened, and reddened by the air.
// composite_constants.glsl holds log2 of its radiance as a parabola over its height. If the photo's own disc is
// larger, because it is clipped or the lens is longer, the new disc is as large.

#include "frame/read_composite_constants.glsl"
#include "sky/described_sky.glsl"
#include "sky/moon_disc.glsl"

uniform float own_disc_burnt;  // how far the photo's own disc is clipped to white, 0 to 1
uniform float own_disc_rim;    // where its light falls to half, in units of its radius, 1.1 to 1.9

const float kBurnt = 30.0;  // light beyond white in the middle of a clipped core, relative to the disc's light

vec3 GetDisc(vec3 view, vec3 sun) {
  vec4 extent = composite[kDisc];
  float radius = extent.x;
  float softness = 1.0 / (camera_focal * frame_size.y);
  float chord = length(view - sun);
  float coverage = step(1e-9, radius) * clamp((radius - chord) / softness + 0.5, 0.0, 1.0);
  float risen = clamp((view.y - GetSineOfHorizon(described[3].x)) / softness + 0.5, 0.0, 1.0);
  float x = min(chord / max(radius, 1e-9), 1.0);
  float moon = GetMoon();
  float limb = 0.5 * log2(max(1.0 - x * x, 1e-4));
  float height = clamp((view.y - extent.y) * extent.z, -1.0, 1.0);
  vec4 middle = vec4(composite[1].w, composite[2].w, composite[3].w, composite[4].w);
  vec4 slope = vec4(composite[5].w, composite[6].w, composite[7].w, composite[8].w);
  vec4 bend = vec4(composite[9].w, extent.w, described[3].zw);
  vec4 radiance = exp2(middle + height * (slope + height * bend) + (1.0 - moon) * limb * kLimbDarkening);
  vec2 place = vec2(dot(view - sun, normalize(vec3(sun.z, 0.0, -sun.x))), (view.y - sun.y) / max(length(sun.xz), 0.1));
  float albedo = 1.0 + moon * (GetMoonAlbedo(place / max(radius, 1e-9)) - 1.0);
  vec4 own = texelFetch(composite_constants, ivec2(kOwnDisc, 0), 0);
  if (own.a > radius) {
    float x = chord / own.a;
    // A sharp rim leaves the disc uniform inside; a glow fades from the middle on.
    vec2 fades = mix(own_disc_rim + vec2(-0.3, 0.2), vec2(0.0, 1.2), smoothstep(1.3, 1.9, own_disc_rim));
    float even = 1.0 - smoothstep(fades.x, fades.y, x);
    // Channels that the air dims more have a smaller clipped core in the camera: a low sun has a warm rim.
    vec3 color = UnpackColor(described[0].w);
    vec3 rim = pow(vec3(even), clamp(color.r / max(color, vec3(1e-6)), 1.0, 5.0));
    float inside = max(1.0 - x * x, 0.0);
    inside *= inside * inside;
    inside *= inside;  // a multiplication is far cheaper than a power
    return risen * (rim + kBurnt * own_disc_burnt * inside * inside) * own.rgb;
  }
  return albedo * coverage * risen * sky_gain * max(SpectralToRec709(radiance), vec3(0.0));
}
