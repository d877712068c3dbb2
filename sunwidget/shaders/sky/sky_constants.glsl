// Values shared by all pixels of sky.glsl.

#define PHOTOS_OWN_LIGHT
#include "sky/describe_sky.glsl"

void SetConstants() {
  SetDescribedSky();
}
