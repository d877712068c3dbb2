// The sky without the old sun, where no clouds are changed (cloud_parts.glsl).

#define CLOUDS_UNEDITED
#include "sky/sky_behind.glsl"
