// A small picture of the new sun's disc, in the photo's scene-linear unit: limb-darkened and
// reddened on its way, transparent black around. It spans kDiscSpan radii to each side.

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"
#include "lib/disc_patch.glsl"

uniform sampler2D columns;
uniform vec2 pass_size;
uniform float altitude;

out vec4 result;

void main() {
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  vec2 offset = (2.0 * gl_FragCoord.xy / pass_size - 1.0) * GetDiscReach();
  vec3 view = normalize(sun + offset.x * GetDiscRight() + offset.y * GetDiscUp());
  float softness = max(1.0 / (camera_focal * frame_size.y), 2.0 * GetDiscReach() / pass_size.x);
  vec4 disc = GetSunDiscRadiance(columns, view, sun, altitude, sun_size, softness);
  result = vec4(sky_gain * max(SpectralToRec709(disc), vec3(0.0)), 1.0);
}
