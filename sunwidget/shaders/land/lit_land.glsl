// Change of the land's light from the photo's sun to the moved one, per surface: the ratio of irradiances
//   E = E_sky(normal) + (direct + gloss) E_sun
// where `direct` is the sun's light on the place past other land, relative to a surface facing the sun. For the photo's
// sun it is visible in the photo (relief): the ratio is computed twice, for shade and for sunshine, and the frame, which
// has the shadows' edges, selects between them (land/read_land_light.glsl). For the moved sun it is predicted from the
// photo (land/read_transfer.glsl); with a given depth map the prediction covers slopes alone, and the depth casts the
// shadows (shadow.glsl).

#include "frame/picture.glsl"
#include "frame/rolled.glsl"
#include "camera/response.glsl"
#include "land/soft_cosine.glsl"
#include "land/land.glsl"
#include "land/relief.glsl"
#include "land/gloss.glsl"
#include "sky/sky_seen.glsl"
#include "sky/sun_visible.glsl"

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
const float kExpected = 0.4;  // weight of the predicted light of the photo's sun against the visible one
const float kEqual = 1e-6;     // relative difference below which irradiances count as equal
const float kSunLeaves = 0.8;  // share of a place's own change at dusk without a sky
const float kLeastOpen = 0.2;  // smallest open share of a slope's sky: no visible place is walled in all round

vec3 GetTerm(int index) {
  return texelFetch(land_terms, ivec2(index, 0), 0).rgb;
}

// Irradiance of the sky and the level land on a surface with this normal, weighted by the squares of the normal's
// components: an ambient cube (McTaggart, "Half-Life 2 / Valve Source Shading", GDC 2004).
vec3 GetSkyIrradiance(int first, vec3 normal) {
  vec3 square = normal * normal;
  vec3 bounce = GetTerm(first + 5);
  vec3 side = normal.x > 0.0 ? GetTerm(first + 1) : GetTerm(first + 2);
  vec3 depth = normal.z > 0.0 ? GetTerm(first + 3) : GetTerm(first + 4);
  vec3 height = normal.y > 0.0 ? GetTerm(first) : bounce;
  return square.x * side + square.y * height + square.z * depth + 0.5 * (square.x + square.z) * bounce;
}

// The same where part of the sky is hidden: there stands land, lit like level land.
vec3 GetOpenIrradiance(int first, vec3 normal, float openness) {
  float most = 0.5 + 0.5 * normal.y;
  float open = clamp(openness / max(most, 0.25), kLeastOpen, 1.0);
  return mix(GetTerm(first + 5), GetSkyIrradiance(first, normal), open);
}

// Shares of one sun's light that reach a place.
struct SunShare {
  float past_land;
  float past_clouds;
  float direct;  // as above; weighted like shadows and slopes
};

// `first` is the state's first texel in land_terms.glsl, `known` the weight of slope and shadows.
vec3 GetIrradiance(int first, Relief land, float openness, float known, float upright, float facing, vec3 view,
                   SunShare share) {
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

// Share of the photo's sun past clouds, and of the moved sun past land and past clouds, averaged over
// neighbors of similar depth: otherwise the march's few steps leave stripes.
vec3 GetSunShare(ivec2 texel, float level) {
  ivec2 last = ivec2(pass_size) - 1;
  vec3 sum = vec3(0.0);
  float total = 0.0;
  for (int i = 0; i < GetSteps(9, pass_size); ++i) {
    ivec2 at = clamp(texel + 2 * (ivec2(i % 3, i / 3) - 1), ivec2(0), last);
    float apart = 32.0 * (ReadPicture(surface, (vec2(at) + 0.5) / pass_size).a - level);
    float weight = 1.0 / (1.0 + apart * apart * apart * apart);
    sum += weight * vec3(texelFetch(shadow_source, at, 0).g, texelFetch(shadow_edit, at, 0).rg);
    total += weight;
  }
  return sum / total;
}

struct LandLight {
  vec3 before;  // irradiance in the photo
  vec3 ratio;   // irradiance now over before
  float level;  // log-depth
};

// Light at this place, with `lit` the share of the photo's sun that reaches it.
LandLight GetLandLight(float lit) {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec2 place = gl_FragCoord.xy / pass_size;
  vec3 view = GetViewDirection(place);
  Relief land = ReadRelief(place);
  float level = ReadPicture(surface, place).a;
  float upright = GetUprightness(view);
  vec4 mean = texelFetch(land_terms, ivec2(16, 0), 0);
  vec3 here = GetSunShare(texel, level);
  vec2 expected = texelFetch(shadow_edit, texel, 0).ba;  // light of the moved sun, and of a uniform sky
  float shine = texelFetch(land_terms, ivec2(15, 0), 0).a;
  float other = GetShadowChange(GetTerm(7), GetTerm(15));
  vec4 share = vec4(lit, here.x, lit + other * (shine * here.y - lit), here.z);
  share = mean + vec2(cast_shadows, cloud_shadows).xyxy * (share - mean);
  float direct = mix(lit * land.facing, texelFetch(shadow_source, texel, 0).b, kExpected);
  SunShare old = SunShare(share.x, share.y, direct);
  SunShare moved = SunShare(share.z, share.w, direct + other * (shine * expected.x - direct));
  vec3 before = GetIrradiance(0, land, expected.y, shading, upright, source_land_facing, view, old);
  vec3 now = GetIrradiance(8, land, expected.y, shading, upright, land_facing, view, moved);
  // With a constant `lit` a compiler may order the two sums differently.
  now = mix(now, before, lessThan(abs(now - before), kEqual * before));
  vec3 ratio = GetRatio(now, before);
  vec3 down = vec3(0.0, -1.0, 0.0);  // a view without gloss
  SunShare all_before = SunShare(mean.x, mean.y, 0.0);
  SunShare all_now = SunShare(mean.z, mean.w, 0.0);
  vec3 plain_before = GetIrradiance(0, land, 1.0, 0.0, 0.5, source_land_facing, down, all_before);
  vec3 plain_now = GetIrradiance(8, land, 1.0, 0.0, 0.5, land_facing, down, all_now);
  // Where the photo's sun is only assumed, its light on each place is half believed, and without a sky all land changes
  // alike. At dusk sunlit places lose their sun, wherever it was.
  vec3 common_ratio = GetRatio(plain_now, plain_before);
  float height = degrees(asin(GetTerm(15).y));
  common_ratio = mix(pow(common_ratio, vec3(GetRestraint(height))), vec3(1.0), equal(common_ratio, vec3(1.0)));
  float own = mix(GetSkySeen() * GetBelief(), max(GetSkySeen(), kSunLeaves), GetDusk(height));
  return LandLight(before, common_ratio + own * (ratio - common_ratio), level);
}
