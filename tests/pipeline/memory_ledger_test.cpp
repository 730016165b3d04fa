#include "pipeline/memory_ledger.h"

#include <gtest/gtest.h>

namespace grove::pipeline {
namespace {

TEST(MemoryLedger, SumsByHolderAndSubject) {
  MemoryLedger ledger;
  const HeldMemory fields(ledger, "light fields", "lightfield", Work::kAcrossUser, 700);
  HeldMemory mine(ledger, "images", "", Work::kPerUserFrontend, 30);
  {
    const HeldMemory yours(ledger, "images", "", Work::kPerUserFrontend, 50);
    EXPECT_EQ(ledger.totals().at({"images", ""}).bytes, 80);
  }
  mine.set(20);
  EXPECT_EQ(ledger.totals().at({"images", ""}).bytes, 20) << "what is gone is not held";
  EXPECT_EQ(ledger.totals().at({"images", ""}).work, Work::kPerUserFrontend);
  EXPECT_EQ(ledger.totals().at({"light fields", "lightfield"}).bytes, 700);
  EXPECT_EQ(ledger.totals().at({"light fields", "lightfield"}).work, Work::kAcrossUser);
}

}  // namespace
}  // namespace grove::pipeline
