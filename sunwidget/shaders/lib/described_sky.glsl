// The matched sky of one sky view with the camera's glare round its sun, in the photo's
// scene-linear unit. What is the same for all pixels comes from lib/describe_sky.glsl.

#include "lib/sky.glsl"
#include "lib/matched_sky.glsl"
#include "lib/camera_glare.glsl"
#include "lib/sun_behind_cloud.glsl"

uniform sampler2D sky_view;

flat in vec4 described[4];

vec3 GetDescribedSun() {
  return described[0].xyz;
}

vec3 GetGlareColor() {
  return UnpackColor(described[0].w);
}

// Alpha: the luminance that is glare.
vec4 GetDescribedSky(vec3 view) {
  SkyView model = SkyView(described[0].xyz, GetShadedAsymmetry(), described[1], described[2], described[3].x);
  float glare = GetCameraGlare(GetDegreesFromSun(view, model.sun)) * described[3].y;
  return vec4(GetMatchedSky(sky_view, model, view) + glare * GetGlareColor(), glare);
}
