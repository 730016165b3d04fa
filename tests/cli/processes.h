#pragma once

#include <string>

#include "cli/program.h"
#include "cli/small_scene.h"

namespace grove::cli {

/// What the scripts share: `owns_world` and `serves NAME OPTIONS` start processes of the small scene, whose output is
/// in NAME.out, their number in $pid_NAME; `kills NAME` returns when the port is free again; `world_of NAME` and
/// `nodes_of NAME` print what a server's report says of its world and its nodes, `page_of NAME PAGE` a whole report.
inline std::string processesOf(const SmallScene& scene) {
  return "folder=$(mktemp -d); cd $folder; trap 'kill -KILL $(jobs -p) 2>/dev/null; rm -r $folder' EXIT\n"
         "starts() { local name=$1; shift; " GROVE_BINARY " \"$@\" --scene " +
         scene.path() +
         " >$name.out 2>&1 & eval pid_$name=$!\n"
         "  until grep -qs '^listening' $name.out; do sleep 0.1; kill -0 $! || { echo $name ended; break; }; done; }\n"
         "kills() { local pid=pid_$1; kill -KILL ${!pid}; wait ${!pid} 2>/dev/null; }\n"
         "port_of() { sed -n \"s/^$1.*:\\([0-9]*\\).*/\\1/p\" $2.out; }\n"
         "owns_world() { starts world world --listen 127.0.0.1:$1; at=$(port_of listening world); }\n"
         "serves() { local name=$1; shift; starts $name serve --listen 127.0.0.1:0 \"$@\"; }\n"
         "report_of() { page_of $1 statistics; }\n"
         "page_of() { exec 3<>/dev/tcp/127.0.0.1/$(port_of operator $1)\n"
         "  printf \"GET /$2.json HTTP/1.1\\r\\nHost: 127.0.0.1\\r\\nConnection: close\\r\\n\\r\\n\" >&3\n"
         "  cat <&3; }\n"
         "world_of() { report_of $1 | grep -ao '\"world\":{[^}]*}'; }\n"
         "nodes_of() { report_of $1 | grep -ao '\"nodes\":\\[.*\\],\"stages\"'; }\n"
         "until_says() { for try in {1..300}; do [[ $($1 $2) == *$3* ]] && return; sleep 0.1; done; echo never: $3;"
         " $1 $2; }\n"
         "until_world() { until_says world_of $1 \"$2\"; }\n"
         "visit() { " GROVE_BINARY
         " load ws://127.0.0.1:$(port_of listening $1)/ --sessions $2 --seconds $3 --width 320 --height 180 --json"
         " 2>/dev/null | grep -o '\"errors\":[0-9]*'; }\n";
}

}  // namespace grove::cli
