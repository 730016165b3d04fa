#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/processes.h"
#include "cli/program.h"

namespace grove::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// What the scripts share besides: `authority NAME`, and `signed NAME AUTHORITY NAMES [OPTIONS]` make NAME.pem and
/// NAME.key, the latter for NAMES of hosts; `soon NAME AUTHORITY SECONDS` makes one that expires so soon. `nodes NAME
/// OPTIONS` starts one that owns all, at the port of $port.
std::string securedProcessesOf(const SmallScene& scene) {
  return processesOf(scene) +
         "new='openssl req -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes'\n"
         "authority() { $new -x509 -days 30 -subj /CN=$1 -keyout $1.key -out $1.pem 2>/dev/null; }\n"
         "signed() { local name=$1 by=$2 names=$3; shift 3; $new -x509 -days 30 -CA $by.pem -CAkey $by.key"
         " -subj /CN=$name -addext subjectAltName=$names \"$@\" -keyout $name.key -out $name.pem 2>/dev/null; }\n"
         "soon() { printf '[ca]\\ndefault_ca=c\\n[c]\\ndatabase=index\\nnew_certs_dir=.\\nserial=serial\\n"
         "default_md=sha256\\npolicy=p\\ncopy_extensions=copy\\n[p]\\ncommonName=supplied\\n' >ca.cnf\n"
         "  : >index; echo 10 >serial; $new -subj /CN=$1 -addext subjectAltName=IP:127.0.0.1 -keyout $1.key"
         " -out $1.csr 2>/dev/null\n"
         "  openssl ca -batch -notext -config ca.cnf -cert $2.pem -keyfile $2.key -in $1.csr -out $1.pem"
         " -startdate $(date -u -d '-1 hour' +%Y%m%d%H%M%SZ) -enddate $(date -u -d \"+$3 seconds\" +%Y%m%d%H%M%SZ)"
         " 2>/dev/null; }\n"
         "nodes() { local name=$1; shift; starts $name node --objects mesh,fluid --listen 127.0.0.1:${port:-0} \"$@\"\n"
         "  port=$(port_of listening $name); }\n"
         "links() { echo --link-tls-ca ${2:-ca}.pem --link-tls-cert $1.pem --link-tls-key $1.key; }\n"
         "listens() { echo --tls-ca ${2:-ca}.pem --tls-cert $1.pem --tls-key $1.key; }\n"
         "fails() { " GROVE_BINARY " serve --listen 127.0.0.1:0 --nodes 127.0.0.1:$port --scene " +
         scene.path() +
         " \"$@\" 2>&1 >/dev/null; echo ended with $?; }\n"
         "says() { for try in {1..100}; do grep -hs -- \"$2\" $1.out && return; sleep 0.1; done; echo never: $2; cat "
         "$1.out; }\n"
         "authority ca; authority foreign; signed node ca IP:127.0.0.1; signed server ca DNS:server\n";
}

TEST(SecureLinks, ServeNodeAndOwner) {
  const SmallScene scene;
  const Outcome outcome = shell(
      securedProcessesOf(scene) +
      "nodes node $(listens node); starts world world --listen 127.0.0.1:0 $(listens node)\n"
      "serves a --nodes 127.0.0.1:$port --join 127.0.0.1:$(port_of listening world) $(links server)\n"
      "until_says nodes_of a welcomed; until_world a joined; visit a 1 2\n"
      "until_says nodes_of a 'round_trip_ms\":[0-9]'; until_world a 'round_trip_ms\":[0-9]'\n"
      "openssl s_client -connect 127.0.0.1:$port </dev/null 2>/dev/null | sed -n 's/^subject=//p'; cat a.out >&2");
  EXPECT_EQ(outcome.output, "\"errors\":0\nCN = node\n");
}

TEST(SecureLinks, NodesWithoutAuthoritiesAcceptAnyServer) {
  const SmallScene scene;
  const Outcome outcome = shell(securedProcessesOf(scene) +
                                "nodes node --tls-cert node.pem --tls-key node.key\n"
                                "serves a --nodes 127.0.0.1:$port --link-tls-ca ca.pem\n"
                                "until_says nodes_of a welcomed; echo done");
  EXPECT_EQ(outcome.output, "done\n");
}

TEST(SecureLinks, CarryASharedWorld) {
  const SmallScene scene;
  const Outcome outcome = shell(securedProcessesOf(scene) +
                                "serves a --share 127.0.0.1:0 $(links node); at=$(port_of 'the world' a)\n"
                                "serves b --join 127.0.0.1:$at $(links server); visit a 1 5 & visit_a=$!\n"
                                "until_world b 'joined\",\"visitors\":1'; wait $visit_a\n"
                                "serves c --join 127.0.0.1:$at; until_says world_of c TLS\n"
                                "says a 'open a link by TLS' | grep -o 'open a link by TLS' | sort -u");
  EXPECT_EQ(outcome.output, "\"errors\":0\nopen a link by TLS\n")
      << "who comes in the clear is heard by nobody, and told why";
}

/// Each has one line at the server, which does not start, and one at the node.
TEST(SecureLinks, UntrustedNodeIsReported) {
  const SmallScene scene;
  const Outcome outcome =
      shell(securedProcessesOf(scene) +
            "signed elsewhere ca DNS:elsewhere; signed client ca IP:127.0.0.1 -addext extendedKeyUsage=clientAuth\n"
            "signed stranger foreign IP:127.0.0.1\n"
            "for name in stranger elsewhere client; do nodes $name $(listens $name); fails $(links server)\n"
            "  says $name 'closed the connection before its hello' | wc -l; kills $name; done\n"
            "soon late ca 3; nodes late $(listens late); sleep 3.5; fails $(links server)");
  EXPECT_THAT(outcome.output, HasSubstr("the node is not trusted: its certificate is signed by 'foreign', no authority "
                                        "of ca.pem"));
  EXPECT_THAT(outcome.output, HasSubstr("the node is not trusted: its certificate does not name 127.0.0.1"));
  EXPECT_THAT(outcome.output, HasSubstr("the node is not trusted: its certificate is for another purpose"));
  EXPECT_THAT(outcome.output, HasSubstr("the node is not trusted: its certificate expired on 2"));
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("ended with 1\n1\n"), Not(HasSubstr("never")), Not(HasSubstr("with 0"))));
}

TEST(SecureLinks, UntrustedServerIsToldTheReason) {
  const SmallScene scene;
  const Outcome outcome = shell(securedProcessesOf(scene) +
                                "signed stranger foreign DNS:server; nodes node $(listens node)\n"
                                "fails --link-tls-ca ca.pem; sleep 1.1; fails $(links stranger); cat node.out");
  EXPECT_THAT(outcome.output, HasSubstr("the node refuses: it shows no certificate"));
  EXPECT_THAT(outcome.output, HasSubstr("the node refuses: its certificate is signed by 'foreign'"));
  EXPECT_THAT(outcome.output, HasSubstr(": it shows no certificate\n"));
  EXPECT_THAT(outcome.output, testing::ContainsRegex("refuses the process at ipv4:127.0.0.1:[0-9]*: its certificate"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("ended with 0")));
}

TEST(SecureLinks, MixedTlsAndPlainIsReported) {
  const SmallScene scene;
  const Outcome outcome = shell(securedProcessesOf(scene) +
                                "nodes plain; fails $(links server); kills plain\n"
                                "nodes node $(listens node); fails; cat node.out");
  EXPECT_THAT(outcome.output, HasSubstr("the node is not trusted: it does not speak TLS"));
  EXPECT_THAT(outcome.output, HasSubstr("no node answers: it closes the connection at once"));
  EXPECT_THAT(outcome.output, HasSubstr("failed to open a link by TLS"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("ended with 0")));
}

TEST(SecureLinks, CarryObstacles) {
  const SmallScene scene;
  const Outcome outcome = shell(
      securedProcessesOf(scene) +
      "signed stranger foreign IP:127.0.0.1; starts stones node --objects mesh --listen 127.0.0.1:0 $(listens node)\n"
      "fire='node --objects fluid --listen 127.0.0.1:0 --obstacles 127.0.0.1:'$(port_of listening stones)\n"
      "starts good $fire $(links server); grep -c listening good.out\n"
      "refused() { " GROVE_BINARY " $fire --scene " +
      scene.path() +
      " \"$@\" 2>&1 >/dev/null; echo ended with $?; }\n"
      "refused $(links server foreign); refused $(links stranger); refused --link-tls-ca ca.pem; refused");
  EXPECT_THAT(outcome.output, testing::StartsWith("1\n"));
  EXPECT_THAT(outcome.output,
              HasSubstr("the node with the obstacles is not trusted: its certificate is signed by 'ca', "
                        "no authority of foreign.pem"));
  EXPECT_THAT(outcome.output, HasSubstr("the node with the obstacles refuses: its certificate is signed by 'foreign'"));
  EXPECT_THAT(outcome.output, HasSubstr("the node with the obstacles refuses: it shows no certificate"));
  EXPECT_THAT(outcome.output, HasSubstr("no node provides obstacles: it closes the connection at once"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("ended with 0")));
}

/// Visitors see the objects as they were, and the operator's page says why.
TEST(SecureLinks, CertificateChangeDisturbsNobody) {
  const SmallScene scene;
  const Outcome outcome =
      shell(securedProcessesOf(scene) +
            "signed stranger foreign IP:127.0.0.1; nodes first $(listens node)\n"
            "serves a --nodes 127.0.0.1:$port $(links server); visit a 2 15 & visit=$!\n"
            "sleep 1; kills first; until_says nodes_of a lost\n"
            "nodes second $(listens stranger); until_says nodes_of a \"untrusted\\\",\\\"reason\\\":\\\"its\"\n"
            "kills second; nodes third $(listens node foreign)\n"
            "until_says nodes_of a \"refused\\\",\\\"reason\\\":\\\"its\"; kills third\n"
            "nodes fourth $(listens node); until_says nodes_of a welcomed; wait $visit; cat a.out >&2");
  EXPECT_EQ(outcome.output, "\"errors\":0\n");
}

TEST(SecureLinks, RefusingOwnerIsReported) {
  const SmallScene scene;
  const Outcome outcome = shell(securedProcessesOf(scene) +
                                "starts world world --listen 127.0.0.1:0 $(listens node)\n"
                                "at=$(port_of listening world); serves a --join 127.0.0.1:$at --link-tls-ca ca.pem\n"
                                "until_says world_of a refused; world_of a\n"
                                "serves b --join 127.0.0.1:$at $(links server foreign)\n"
                                "until_says world_of b refused; world_of b; visit b 1 1");
  EXPECT_THAT(outcome.output, HasSubstr("it shows no certificate"));
  EXPECT_THAT(outcome.output, HasSubstr("its certificate is signed by 'ca', no authority of foreign.pem"));
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("\"errors\":0"), Not(HasSubstr("never"))));
}

TEST(SecureLinks, BadFilesAreReported) {
  const SmallScene scene;
  const Outcome outcome =
      shell(securedProcessesOf(scene) +
            "port=1; fails $(links server none); fails $(links none); fails --link-tls-ca ca.key\n" +
            GROVE_BINARY
            " node --objects mesh --listen 127.0.0.1:0 --tls-cert node.pem --tls-key server.key 2>&1; "
            "echo ended with $?");
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("--link-tls-ca: none.pem: cannot open it: No such file"),
                                    HasSubstr("--link-tls-cert: none.pem: cannot open it: No such file"),
                                    HasSubstr("--link-tls-ca ca.key: has no readable certificate"),
                                    HasSubstr("--tls-key server.key: is not the key of the certificate in node.pem"),
                                    Not(HasSubstr("with 0"))));
}

}  // namespace
}  // namespace grove::cli
