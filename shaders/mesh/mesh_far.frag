#version 450 core
#include "mesh/shading.glsl"
