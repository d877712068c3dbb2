// Water away from the old sun's glints (water_parts.glsl), which keeps its own light.

#define NO_GLINTS
#include "water/water_behind.glsl"
