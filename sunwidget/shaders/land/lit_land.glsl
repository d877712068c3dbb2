// How the land's light changes from the photo's sun to the moved one, per surface: the ratio of irradiances
//   E = E_sky(normal) + (direct + gloss) E_sun
// where `direct` is what of the sun's light falls on the place past other land, by what falls on a surface that faces
// it. In the photo that is seen (relief), so the ratio is asked for twice, for a place in shadow and for one in the
// sun, and the frame, which has the shadows' edges, chooses (land/read_land_light.glsl). Of the moved sun it is what the
// photo lets expect (land/read_transfer.glsl); of a depth that somebody told that knows slopes alone, and the shadows are
// what the depth casts (shadow.glsl).

#include "frame/picture.glsl"
#include "camera/response.glsl"
#include "land/soft_cosine.glsl"
#include "land/land.glsl"
#include "land/relief.glsl"
#include "land/gloss.glsl"
#include "sky/sky_seen.glsl"

uniform sampler2D land_terms;
uniform sampler2D surface;
uniform sampler2D shadow_source;
uniform sampler2D shadow_edit;
uniform vec2 pass_size;
uniform float shading;
uniform float gloss;
uniform float cast_shadows;
uniform float cloud_shadows;
uniform float land_facing;
uniform float source_land_facing;

// Walls and slopes are smoother than the ground.
const float kWallRoughness = 0.04;
const float kExpected = 0.4;  // of the light of the photo's sun: what its land lets expect, over what is seen of it
const float kAlike = 1e-6;
const float kLeastOpen = 0.2;  // of what a slope sees of the sky: no wall stands all round a place that is seen

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

// What of the sky a place does not see is land, lit as lying land is.
vec3 GetOpenIrradiance(int first, vec3 normal, float openness) {
  float most = 0.5 + 0.5 * normal.y;
  float open = clamp(openness / max(most, 0.25), kLeastOpen, 1.0);
  return mix(GetTerm(first + 5), GetSkyIrradiance(first, normal), open);
}

// What of one sun reaches a place.
struct SunShare {
  float past_land;
  float past_clouds;
  float direct;  // as above; believed as far as shadows and slopes are
};

// `first` is the first texel of the state in land_terms.glsl; `known` how far slope and shadows are believed.
vec3 GetIrradiance(int first, Relief land, float openness, float known, float upright, float facing, vec3 view, SunShare share) {
  vec3 sun = GetTerm(first + 7);
  float stands = mix(facing, 1.0, upright);
  vec3 sky = mix(GetTerm(first), GetTerm(first + 4) + 0.5 * GetTerm(first + 5), stands);
  float cosine = mix(GetSoftCosine(sun.y, kRoughness), GetSoftCosine(-sun.z, kWallRoughness), stands);
  sky += known * (GetOpenIrradiance(first, land.normal, openness) - sky);
  float lies = clamp(land.normal.y, 0.0, 1.0);
  float slope = GetSoftCosine(dot(land.normal, sun), mix(kWallRoughness, kRoughness, lies));
  cosine += known * (slope - cosine);
  float direct = share.past_land * cosine;
  direct += known * cast_shadows * (share.direct - direct);
  float flat_share = mix(1.0 - upright, lies * lies, known);
  direct += share.past_land * gloss * flat_share * GetGloss(view, sun);
  return sky + share.past_clouds * direct * GetTerm(first + 6);
}

// What of the photo's sun comes past clouds, and of the moved sun past land and past clouds, averaged with
// neighbors of like depth: the march's few steps leave stripes else.
vec3 GetSunShare(ivec2 texel, float level) {
  ivec2 last = ivec2(pass_size) - 1;
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      ivec2 at = clamp(texel + 2 * ivec2(column, row), ivec2(0), last);
      float apart = 32.0 * (ReadPicture(surface, (vec2(at) + 0.5) / pass_size).a - level);
      float weight = 1.0 / (1.0 + apart * apart * apart * apart);
      sum += weight * vec3(texelFetch(shadow_source, at, 0).g, texelFetch(shadow_edit, at, 0).rg);
      total += weight;
    }
  }
  return sum / total;
}

struct LandLight {
  vec3 before;  // irradiance in the photo
  vec3 ratio;   // of what there is now
  float level;  // log-depth
};

// Of a place that the photo's sun reaches as far as `lit` says.
LandLight GetLandLight(float lit) {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 place = gl_FragCoord.xy / pass_size;
  vec3 view = GetViewDirection(place);
  Relief land = ReadRelief(place);
  float level = ReadPicture(surface, place).a;
  float upright = GetUprightness(view);
  vec4 mean = texelFetch(land_terms, ivec2(16, 0), 0);
  vec3 here = GetSunShare(texel, level);
  vec2 expected = texelFetch(shadow_edit, texel, 0).ba;  // light of the moved sun, and of an even sky
  float shine = texelFetch(land_terms, ivec2(15, 0), 0).a;
  float other = GetOtherShadows(GetTerm(7), GetTerm(15));
  vec4 share = vec4(lit, here.x, lit + other * (shine * here.y - lit), here.z);
  share = mean + vec2(cast_shadows, cloud_shadows).xyxy * (share - mean);
  float direct = mix(lit * land.facing, texelFetch(shadow_source, texel, 0).b, kExpected);
  SunShare old = SunShare(share.x, share.y, direct);
  SunShare moved = SunShare(share.z, share.w, direct + other * (shine * expected.x - direct));
  vec3 before = GetIrradiance(0, land, expected.y, shading, upright, source_land_facing, view, old);
  vec3 now = GetIrradiance(8, land, expected.y, shading, upright, land_facing, view, moved);
  // A constant `lit` lets a compiler order the sums of the one otherwise than those of the other.
  now = mix(now, before, lessThan(abs(now - before), kAlike * before));
  vec3 ratio = GetRatio(now, before);
  vec3 down = vec3(0.0, -1.0, 0.0);  // where nothing gleams
  SunShare all_before = SunShare(mean.x, mean.y, 0.0);
  SunShare all_now = SunShare(mean.z, mean.w, 0.0);
  vec3 plain_before = GetIrradiance(0, land, 1.0, 0.0, 0.5, source_land_facing, down, all_before);
  vec3 plain_now = GetIrradiance(8, land, 1.0, 0.0, 0.5, land_facing, down, all_now);
  vec3 as_one = GetRatio(plain_now, plain_before);
  as_one = mix(pow(as_one, vec3(kRestraint)), vec3(1.0), equal(as_one, vec3(1.0)));
  return LandLight(before, as_one + GetSkySeen() * (ratio - as_one), level);
}
