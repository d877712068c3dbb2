// The frame where a pixel is sky and nothing else, away from the old sun's glare (frame_parts.glsl).

#define SKY_ALONE
#include "frame/frame.glsl"
