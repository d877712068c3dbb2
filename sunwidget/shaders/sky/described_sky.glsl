// The matched sky of one sky view, in the photo's scene-linear unit, and the camera's glare. Values shared by
// all pixels come from sky/describe_sky.glsl and frame_constants.glsl.

#include "atmosphere/read_sky_view.glsl"
#include "sky/matched_sky.glsl"
#include "camera/camera_glare.glsl"
#include "sky/sun_behind_cloud.glsl"

uniform sampler2D sky_view;

flat in vec4 described[4];

vec3 GetDescribedSun() {
  return described[0].xyz;
}

vec3 GetDescribedSky(vec3 view) {
  SkyView model = SkyView(described[0].xyz, GetShadedAsymmetry(), described[1], described[2], described[3].x);
  return GetMatchedSky(sky_view, model, view);
}
