// How the land's light changes from the photo's sun to the moved one, per surface: rgb the ratio
// of irradiances, alpha the log-depth of the land here, by which the frame chooses among its texels.
//   E = E_sky(normal) + visible (cos+(normal, sun) + gloss) E_sun
// What is known of the land's slope goes by `shading`, the rest by two classes: what is lower than
// the horizon lies, what rises above it stands upright and faces the camera.

#include "lib/picture.glsl"
#include "lib/response.glsl"
#include "lib/soft_cosine.glsl"
#include "lib/land.glsl"
#include "lib/gloss.glsl"
#include "lib/sky_seen.glsl"

uniform sampler2D land_terms;
uniform sampler2D land_shape;
uniform sampler2D shadow_source;
uniform sampler2D shadow_edit;
uniform vec2 pass_size;
uniform float shading;
uniform float gloss;
uniform float cast_shadows;
uniform float cloud_shadows;
uniform float land_facing;
uniform float source_land_facing;

out vec4 result;

// Walls and slopes are smoother than the ground.
const float kWallRoughness = 0.04;

vec3 GetTerm(int index) {
  return texelFetch(land_terms, ivec2(index, 0), 0).rgb;
}

// Irradiance of the sky and of the lying land on a surface with this normal: by the squares of its
// components, as an ambient cube (McTaggart, "Half-Life 2 / Valve Source Shading", GDC 2004).
vec3 GetSkyIrradiance(int first, vec3 normal) {
  vec3 square = normal * normal;
  vec3 bounce = GetTerm(first + 5);
  vec3 side = normal.x > 0.0 ? GetTerm(first + 1) : GetTerm(first + 2);
  vec3 depth = normal.z > 0.0 ? GetTerm(first + 3) : GetTerm(first + 4);
  vec3 height = normal.y > 0.0 ? GetTerm(first) : bounce;
  return square.x * side + square.y * height + square.z * depth + 0.5 * (square.x + square.z) * bounce;
}

// `first` is the first texel of the state in land_terms.glsl.
vec3 GetIrradiance(int first, vec3 normal, float sure, float upright, float facing, vec3 view, float visible) {
  vec3 sun = GetTerm(first + 7);
  float stands = mix(facing, 1.0, upright);
  vec3 sky = mix(GetTerm(first), GetTerm(first + 4) + 0.5 * GetTerm(first + 5), stands);
  float cosine = mix(GetSoftCosine(sun.y, kRoughness), GetSoftCosine(-sun.z, kWallRoughness), stands);
  float known = shading * sure;
  sky += known * (GetSkyIrradiance(first, normal) - sky);
  float lies = clamp(normal.y, 0.0, 1.0);
  float slope = GetSoftCosine(dot(normal, sun), mix(kWallRoughness, kRoughness, lies));
  cosine += known * (slope - cosine);
  float flat_share = mix(1.0 - upright, lies * lies, known);
  cosine += gloss * flat_share * GetGloss(view, sun);
  return sky + visible * cosine * GetTerm(first + 6);
}

// What of the sun reaches a place, averaged with neighbours of like depth: the march's few steps
// leave stripes else.
vec4 GetSunShare(ivec2 texel, float level) {
  ivec2 last = ivec2(pass_size) - 1;
  vec4 sum = vec4(0.0);
  float total = 0.0;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      ivec2 at = clamp(texel + 2 * ivec2(column, row), ivec2(0), last);
      float apart = 32.0 * (texelFetch(land_shape, at, 0).a - level);
      float weight = 1.0 / (1.0 + apart * apart * apart * apart);
      sum += weight * vec4(texelFetch(shadow_source, at, 0).rg, texelFetch(shadow_edit, at, 0).rg);
      total += weight;
    }
  }
  return sum / total;
}

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec3 view = GetViewDirection(gl_FragCoord.xy / pass_size);
  vec4 shape = texelFetch(land_shape, texel, 0);
  float sure = min(length(shape.rgb), 1.0);
  vec3 normal = shape.rgb / max(sure, 1e-6);
  float upright = GetUprightness(view);
  vec4 mean = texelFetch(land_terms, ivec2(16, 0), 0);
  vec4 here = GetSunShare(texel, shape.a);
  vec4 sun_share = mean + vec2(cast_shadows, cloud_shadows).xyxy * (here - mean);
  vec3 before = GetIrradiance(0, normal, sure, upright, source_land_facing, view, sun_share.x * sun_share.y);
  vec3 now = GetIrradiance(8, normal, sure, upright, land_facing, view, sun_share.z * sun_share.w);
  vec3 ratio = GetRatio(now, before);
  vec3 down = vec3(0.0, -1.0, 0.0);  // where nothing gleams
  vec3 plain_before = GetIrradiance(0, normal, 0.0, 0.5, source_land_facing, down, mean.x * mean.y);
  vec3 plain_now = GetIrradiance(8, normal, 0.0, 0.5, land_facing, down, mean.z * mean.w);
  vec3 as_one = GetRatio(plain_now, plain_before);
  as_one = mix(pow(as_one, vec3(kRestraint)), vec3(1.0), equal(as_one, vec3(1.0)));
  result = vec4(as_one + GetSkySeen() * (ratio - as_one), shape.a);
}
