// What all pixels of the frame share: composite_constants.glsl, and the sky at the moved sun.

#include "sky/describe_sky.glsl"
#include "camera/camera_glare.glsl"

uniform sampler2D terms;

flat out vec4 term[11];

void SetConstants() {
  for (int i = 0; i < 11; ++i) term[i] = texelFetch(terms, ivec2(i, 0), 0);
  SetDescribedSky();
  // More texels would be more than a vertex may hand over; of these only the alphas and the glare are asked for.
  described[3].zw = vec2(texelFetch(terms, ivec2(11, 0), 0).a, texelFetch(terms, ivec2(12, 0), 0).a);
  vec3 glare = texelFetch(terms, ivec2(13, 0), 0).rgb;
  described[0].w = PackColor(glare);
  described[3].y = dot(glare, vec3(0.2126, 0.7152, 0.0722));
}
