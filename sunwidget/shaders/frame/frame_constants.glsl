// The values that all pixels of the frame share: composite_constants.glsl, and the sky at the moved sun.

#include "frame/composite_texels.glsl"
#include "sky/describe_sky.glsl"
#include "camera/camera_glare.glsl"

uniform sampler2D composite_constants;

flat out vec4 composite[11];

void SetConstants() {
  for (int i = 0; i < 11; ++i) composite[i] = texelFetch(composite_constants, ivec2(i, 0), 0);
  SetDescribedSky();
  // More texels would exceed what a vertex may pass on. Of the others only these alphas and the glare are needed.
  described[3].zw = vec2(texelFetch(composite_constants, ivec2(kWaterSunBefore, 0), 0).a,
                         texelFetch(composite_constants, ivec2(kWaterSunNow, 0), 0).a);
  vec3 glare = texelFetch(composite_constants, ivec2(kGlare, 0), 0).rgb;
  described[0].w = PackColor(glare);
  described[3].y = dot(glare, vec3(0.2126, 0.7152, 0.0722));
}
