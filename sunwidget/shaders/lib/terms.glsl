// The first texels of terms.glsl, by way of frame_constants.glsl.

flat in vec4 term[11];
