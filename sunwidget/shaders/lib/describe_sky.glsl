// For a pass's constants: what a look-up in one sky view needs beside its radiances, read once.
// lib/described_sky.glsl takes it up.

#include "lib/sky.glsl"
#include "lib/daylight.glsl"
#include "lib/matched_sky.glsl"
#include "lib/camera_glare.glsl"
#include "lib/sun_behind_cloud.glsl"

uniform sampler2D sky_view;
uniform sampler2D light;
uniform sampler2D light_before;
uniform sampler2D visibility;

flat out vec4 described[4];

void SetDescribedSky() {
  SkyView view = ReadSkyView(sky_view);
  float visible = texelFetch(visibility, ivec2(0), 0).r;
  vec3 beam = GetLightTexel(light, 1);
  float glare = GetGlareStrength(GetLightRatio(beam, GetLightTexel(light_before, 1)),
      GetLightRatio(GetLightTexel(light, 0), GetLightTexel(light_before, 0)), visible);
  described[0] = vec4(view.sun, PackColor(sky_gain * beam));
  described[1] = view.rayleigh;
  described[2] = view.mie * GetShadedShare();
  described[3] = vec4(view.horizon, glare * GetLightScale(GetMoon()).g, 0.0, 0.0);
}
