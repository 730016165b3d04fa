#include "cli/command_line.h"

int main(int argc, char** argv) { return grove::cli::run(argc, argv); }
