#version 450 core
#define FINE
#include "mesh/shading.glsl"
