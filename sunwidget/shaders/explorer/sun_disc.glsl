// A small picture of the sun's disc, linear Rec. 709 in kcd m^-2: limb-darkened, reddened by the
// air, and cut by the horizon. See explorer/read_sun_disc.glsl.

#include "explorer/projection.glsl"
#include "atmosphere/sun_disc_radiance.glsl"
#include "explorer/read_sun_disc.glsl"

uniform vec2 pass_size;
uniform float altitude;
uniform sampler2D columns;
out vec4 result;

void main() {
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  vec2 offset = (2.0 * gl_FragCoord.xy / pass_size - 1.0) * GetDiscReach();
  vec3 view = normalize(sun + offset.x * GetDiscRight() + offset.y * GetDiscUp());
  float softness = max(GetPixelAngle(), 2.0 * GetDiscReach() / pass_size.x);
  float h = clamp(altitude, 1.0, 0.99 * kAtmosphereHeight);
  vec4 disc = GetSunDiscRadiance(columns, view, sun, h, sun_size, softness);
  result = vec4(max(SpectralToRec709(disc), 0.0), 1.0);
}
