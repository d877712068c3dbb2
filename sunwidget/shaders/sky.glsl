// The matched sky at every pixel, in the photo's scene-linear unit: model times gain, with the
// camera's glare round the sun. Drawn twice, at the photo's own sun and at the moved one; their
// quotient relights the sky.

#include "lib/picture.glsl"
#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"
#include "lib/daylight.glsl"
#include "lib/camera_glare.glsl"

uniform sampler2D sky_view;
uniform sampler2D light;
uniform sampler2D light_source;
uniform sampler2D visibility;
uniform vec2 tile_origin;
uniform float sun_azimuth;
uniform float sun_elevation;

out vec4 result;

void main() {
  vec2 place = (gl_FragCoord.xy + tile_origin) / frame_size;
  vec3 view = GetViewDirection(place);
  vec3 sun = GetSunDirection(sun_azimuth, sun_elevation);
  float from_sun = degrees(2.0 * asin(min(0.5 * length(view - sun), 1.0)));
  float visible = texelFetch(visibility, ivec2(0), 0).r;
  float glare = GetCameraGlare(from_sun)
      * GetGlareStrength(GetLightTexel(light, 1), GetLightTexel(light_source, 1), visible);
  result = vec4(GetMatchedSky(sky_view, view) * (1.0 + glare), 1.0);
}
