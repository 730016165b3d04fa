#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <set>

#include "cli/bench/amortize/bench_amortize_report.h"
#include "cli/bench/codec_names.h"

namespace grove::cli {
namespace {

using measure::FrameCost;

[[gnu::format(printf, 2, 3)]] void print(std::string& out, const char* format, ...) {
  std::array<char, 512> line{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line.data(), line.size(), format, arguments);
  va_end(arguments);
  out += line.data();
}

std::string shown(const std::optional<double>& value) {
  std::string out;
  if (value) print(out, "%.2f", *value);
  return value ? out : "-";
}

void printRows(std::string& out, const std::vector<AmortizeRow>& rows) {
  print(out,
        "Milliseconds of CPU in a frame; cores of the process, its drivers' threads and the rest no stage reports;\n");
  print(out,
        "cores that 30 frames a second for all need (* the machine gives fewer, and each of them costs more).\n\n");
  print(out,
        "visitors mode    walk     codec      c_i   c_b0   c_b1    c_f alpha0 alpha1  beta |    fps  p99 ms |   CPU "
        "driver  "
        "rest "
        "needed\n");
  for (const AmortizeRow& row : rows) {
    const FrameCost cost = row.cost();
    print(out,
          "%8d %-7s %-8s %-5s %6.2f %6.2f %6.2f %6.2f  %5.3f  %5.3f %5.3f | %6.2f %7.0f | %5.2f  %5.2f %5.2f %6.2f%s\n",
          row.users, row.privateWorlds ? "private" : "shared", nameOf(row.course).c_str(), codecName(row.codec).c_str(),
          cost.acrossUser, cost.backend, cost.backendCompressed(), cost.frontend, measure::alpha0(cost),
          measure::alpha1(cost), measure::sum(row.memory).beta(), row.fps(), row.latency(0.99), row.cpuCores,
          row.driverCores, row.otherCores(), row.coresNeeded(), row.saturated() ? "*" : "");
  }
}

/// Shows what of c_i comes from sharing between visitors, and not from a visitor's own reuse.
void printReuse(std::string& out, const std::vector<AmortizeRow>& rows) {
  print(
      out,
      "\nViews made on demand: those that one visitor used, or several (their share of the ms is in c_i, the rest in\n"
      "c_b0), and their further uses, by the first visitor or by others\n\n");
  print(out, "visitors mode    walk     codec     made    one several |   again  others |    c_i   c_b0\n");
  for (const AmortizeRow& row : rows) {
    const pipeline::Reuse& reuse = row.reuse;
    const FrameCost cost = row.cost();
    print(out, "%8d %-7s %-8s %-5s %7llu %6llu %7llu | %7llu %7llu | %6.2f %6.2f\n", row.users,
          row.privateWorlds ? "private" : "shared", nameOf(row.course).c_str(), codecName(row.codec).c_str(),
          static_cast<unsigned long long>(reuse.made), static_cast<unsigned long long>(reuse.usedByOne()),
          static_cast<unsigned long long>(reuse.shared), static_cast<unsigned long long>(reuse.usesAgain),
          static_cast<unsigned long long>(reuse.usesByOthers), cost.onDemandShared, cost.onDemandOwn);
  }
}

void printTypes(std::string& out, const AmortizeRow& row) {
  const auto mega = [](double bytes) { return bytes * 1e-6; };
  print(out, "\nBy type of object, %d visitors, %s; MB of the across-user state and of one visitor\n\n", row.users,
        row.privateWorlds ? "private" : "shared");
  print(out, "type            c_i   c_b0   c_b1    c_f alpha1 |      m_i    m_b    m_f   beta\n");
  std::set<std::string> types;
  for (const auto& [type, cost] : row.costs) types.insert(type);
  for (const auto& [type, share] : row.memory) types.insert(type);
  const auto line = [&](const char* name, const FrameCost& cost, const measure::MemoryShare& share) {
    print(out, "%-12s %6.2f %6.2f %6.2f %6.2f  %5.3f | %8.2f %6.2f %6.2f  %5.3f\n", name, cost.acrossUser, cost.backend,
          cost.backendCompressed(), cost.frontend, measure::alpha1(cost), mega(share.acrossUser),
          mega(share.perUserBackend), mega(share.perUserFrontend), share.beta());
  };
  for (const std::string& type : types) {
    const auto cost = row.costs.find(type);
    const auto share = row.memory.find(type);
    line(type.empty() ? "(of none)" : type.c_str(), cost != row.costs.end() ? cost->second : FrameCost(),
         share != row.memory.end() ? share->second : measure::MemoryShare());
  }
  line("all", row.cost(), measure::sum(row.memory));
  print(out, "\nresident %.0f MB (%.0f MB with its share of shared pages), of which %.0f MB are reported above\n",
        mega(static_cast<double>(row.process.resident)), mega(static_cast<double>(row.process.proportional)),
        mega(row.reportedBytes));
}

void printFit(std::string& out, const char* mode, const ModeFit& fit) {
  const Capacity& capacity = fit.capacity;
  print(out, "%-8s", mode);
  if (fit.line) {
    print(out, " CPU(N) = %.3f [%.3f, %.3f] + %.3f [%.3f, %.3f] N, r^2 %.4f", fit.line->a.value, fit.line->a.low,
          fit.line->a.high, fit.line->b.value, fit.line->b.low, fit.line->b.high, fit.line->rSquared);
    out += ", over";
    for (const int users : fit.over) print(out, " %d", users);
    out += ";";
  } else {
    print(out, " no line over fewer than five numbers of visitors that are served;");
  }
  print(out, " serves %d", capacity.served);
  if (capacity.unserved) {
    print(out, " and not %d", *capacity.unserved);
  } else {
    print(out, " and perhaps more");
  }
  print(out, ", by the line %s\n", shown(capacity.fitted).c_str());
}

/// Where the slopes and the stages give different shares, these are the numbers that differ.
void printReasons(std::string& out, const std::vector<AmortizeRow>& rows) {
  const AmortizeRow* shared = fullest(rows, false);
  const AmortizeRow* unshared = fullest(rows, true);
  if (shared == nullptr || unshared == nullptr) return;
  print(out, "\nWhat the law takes to be equal in both modes, ms in a frame (shared / private)\n");
  const auto line = [&](const char* name, double a, double b) { print(out, "  %-34s %7.2f / %7.2f\n", name, a, b); };
  line("c_i, one copy", shared->cost().acrossUser, unshared->cost().acrossUser);
  for (const auto& [type, cost] : shared->costs) {
    const auto other = unshared->costs.find(type);
    const double b = other != unshared->costs.end() ? other->second.acrossUser : 0.0;
    if (cost.acrossUser > 0.0 || b > 0.0) {
      line(("    of " + (type.empty() ? std::string("none") : type)).c_str(), cost.acrossUser, b);
    }
  }
  line("c_b1 + c_f, one visitor", shared->cost().perUser(), unshared->cost().perUser());
  const auto unreported = [](const AmortizeRow& row) {
    return (row.cpuCores - row.stageCores) * row.seconds / std::max(1.0, row.frames) * 1e3;
  };
  line("in no stage, one visitor", unreported(*shared), unreported(*unshared));
}

void printLaw(std::string& out, const AmortizeResult& result) {
  const AmortizeLaw law = amortizeLaw(result.rows, result.cores);
  print(out, "\nCores over visitors, with 95 %% confidence; visitors at 30 frames a second on %d cores\n\n", law.cores);
  printFit(out, "shared", law.shared);
  printFit(out, "private", law.unshared);
  print(out, "alpha    %s by stages, %s by the slopes\n", shown(law.alphaStages).c_str(), shown(law.alphaFit).c_str());
  print(out,
        "M = N(1 - alpha) + alpha: %s private visitors expected by stages, %s by the slopes; %s by private mode's own "
        "line\n",
        shown(law.lawStages).c_str(), shown(law.lawFit).c_str(), shown(law.unshared.capacity.fitted).c_str());
  print(out, "shared over private: %s\n", shown(law.gain).c_str());
  printReasons(out, result.rows);
}

void printFigure(std::string& out, const std::vector<FigureColumn>& figure) {
  print(out, "\nThe paper's Figure 5.6, of the fluid alone: milliseconds of CPU in a frame\n");
  const auto line = [&](const char* name, auto value, const char* format) {
    print(out, "%-10s", name);
    for (const FigureColumn& column : figure) print(out, format, value(column));
    out += "\n";
  };
  out += "\n";
  line(
      "grid", [](const FigureColumn& c) { return c.grid; }, "%10d");
  line(
      "frames", [](const FigureColumn& c) { return c.frames; }, "%10d");
  line(
      "frontends", [](const FigureColumn& c) { return c.frontends; }, "%10d");
  line(
      "c_i", [](const FigureColumn& c) { return c.cost.acrossUser; }, "%10.2f");
  line(
      "c_b0", [](const FigureColumn& c) { return c.cost.backend; }, "%10.3f");
  line(
      "c_b1", [](const FigureColumn& c) { return c.cost.backendCompressed(); }, "%10.3f");
  line(
      "c_f", [](const FigureColumn& c) { return c.cost.frontend; }, "%10.2f");
  line(
      "alpha0", [](const FigureColumn& c) { return measure::alpha0(c.cost); }, "%10.3f");
  line(
      "alpha1", [](const FigureColumn& c) { return measure::alpha1(c.cost); }, "%10.3f");
}

}  // namespace

std::string amortizeTables(const AmortizeResult& result) {
  std::string out;
  if (!result.rows.empty()) {
    const std::vector<AmortizeRow> all = result.allRows();
    printRows(out, all);
    printReuse(out, all);
    for (const bool privateWorlds : {false, true}) {
      if (const AmortizeRow* row = fullest(result.rows, privateWorlds)) printTypes(out, *row);
    }
    printLaw(out, result);
  }
  if (!result.figure.empty()) printFigure(out, result.figure);
  if (result.interrupted) out += "\ninterrupted: this is what was measured by then\n";
  return out;
}

}  // namespace grove::cli
