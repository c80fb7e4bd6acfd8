#include "io/csv.h"

#include <gtest/gtest.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "io/files.h"
#include "scene/user_error.h"
#include "scratch.h"

namespace pseudorigid::io::test {
namespace {

using Columns = std::vector<std::string>;
const Columns abc{"a", "b", "c"};

/// A double with any bit pattern that is finite: every exponent and sign, subnormal numbers too.
double random_double(std::mt19937_64& random) {
  for (;;) {
    const double x = std::bit_cast<double>(random());
    if (std::isfinite(x)) return x;
  }
}

void write_rows(const std::filesystem::path& path, int n_rows) {
  CsvWriter writer = CsvWriter::create(path, abc);
  for (int i = 0; i < n_rows; ++i) writer.append(std::vector<double>{i + 0., i / 3., -1. / (i + 1)});
  writer.flush();
}

TEST(Csv, RandomDoublesSurviveBitByBit) {
  const ScratchDirectory scratch;
  std::mt19937_64 random(1);
  std::vector<double> values{0.,
                             -0.,
                             0.1,
                             std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::min(),
                             std::numeric_limits<double>::denorm_min()};
  while (values.size() < 3 * 40000) values.push_back(random_double(random));
  {
    CsvWriter writer = CsvWriter::create(scratch / "t.csv", abc);
    for (std::size_t i = 0; i < values.size(); i += 3) writer.append(std::span(values).subspan(i, 3));
    writer.flush();
    EXPECT_EQ(writer.n_rows(), 40000);
  }
  const Table table = read_csv(scratch / "t.csv");
  EXPECT_EQ(table.columns, abc);
  ASSERT_EQ(table.values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(table.values[i]), std::bit_cast<std::uint64_t>(values[i])) << i;
}

TEST(Csv, HasSeventeenDigitsAndCommas) {
  const ScratchDirectory scratch;
  CsvWriter writer = CsvWriter::create(scratch / "t.csv", abc);
  writer.append(std::vector<double>{1, 0.1, -1e300});
  writer.flush();
  EXPECT_EQ(contents(scratch / "t.csv"), "a,b,c\n1,0.10000000000000001,-1.0000000000000001e+300\n");
}

TEST(Csv, ColumnsAreFoundByName) {
  const ScratchDirectory scratch;
  write_rows(scratch / "t.csv", 3);
  const Table table = read_csv(scratch / "t.csv");
  EXPECT_EQ(table.n_rows(), 3u);
  EXPECT_EQ(table.column("c"), (std::vector<double>{-1, -0.5, -1. / 3}));
  EXPECT_EQ(table.row(2)[1], 2 / 3.);
  EXPECT_TRUE(table.has_column("b"));
  EXPECT_FALSE(table.has_column("B"));
  EXPECT_THROW(table.column("d"), UserError);
}

TEST(Csv, NoRowReachesTheFileBeforeFlushAndEveryRowDoes) {
  const ScratchDirectory scratch;
  CsvWriter writer = CsvWriter::create(scratch / "t.csv", abc);
  EXPECT_EQ(contents(scratch / "t.csv"), "a,b,c\n");
  writer.append(std::vector<double>{1, 2, 3});
  EXPECT_EQ(read_csv(scratch / "t.csv").n_rows(), 0u);
  writer.flush();
  EXPECT_EQ(read_csv(scratch / "t.csv").n_rows(), 1u);
}

TEST(Csv, DestructorWritesWhatIsPending) {
  const ScratchDirectory scratch;
  {
    CsvWriter writer = CsvWriter::create(scratch / "t.csv", abc);
    writer.append(std::vector<double>{1, 2, 3});
    std::optional<CsvWriter> moved(std::move(writer));
    moved->append(std::vector<double>{4, 5, 6});
  }
  EXPECT_EQ(contents(scratch / "t.csv"), "a,b,c\n1,2,3\n4,5,6\n");
}

TEST(Csv, ANumberThatIsNotFiniteIsADefectAndLeavesNoRow) {
  const ScratchDirectory scratch;
  CsvWriter writer = CsvWriter::create(scratch / "t.csv", abc);
  for (const double bad : {NAN, INFINITY, -INFINITY}) {
    const auto message = message_of<std::logic_error>([&] { writer.append(std::vector<double>{1, bad, 3}); });
    EXPECT_NE(message.find("t.csv: b is"), message.npos) << message;
  }
  EXPECT_THROW(writer.append(std::vector<double>{1, 2}), std::logic_error);
  writer.flush();
  EXPECT_EQ(contents(scratch / "t.csv"), "a,b,c\n");
  EXPECT_EQ(writer.n_rows(), 0);
}

TEST(Csv, BadFilesAreNamedWithTheLine) {
  const ScratchDirectory scratch;
  const auto complaint = [&](const std::string& text) {
    put(scratch / "t.csv", text);
    return message_of<UserError>([&] { read_csv(scratch / "t.csv"); });
  };
  EXPECT_NE(complaint("").find("t.csv:1: expected a line of column names"), std::string::npos);
  EXPECT_NE(complaint("a,b").find("t.csv:1:"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,2\n3\n").find("t.csv:3: expected 2 numbers"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,2,3\n").find("t.csv:2: expected 2 numbers"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,x\n").find("t.csv:2: column 2"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,nan\n").find("t.csv:2: column 2: expected a finite number"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,\n").find("t.csv:2: column 2"), std::string::npos);
  EXPECT_NE(complaint("a,b\n\n").find("t.csv:2:"), std::string::npos);
  EXPECT_NE(complaint("a,b\n1,2\n3,4").find("t.csv:3: the last line is incomplete"), std::string::npos);
  EXPECT_EQ(complaint("a,b\n1,2\n"), "");
  const auto missing = message_of<UserError>([&] { read_csv(scratch / "none.csv"); });
  EXPECT_NE(missing.find("No such file or directory"), missing.npos) << missing;
  EXPECT_THROW(read_csv(scratch.path()), UserError);
}

TEST(Csv, ResumeKeepsTheRowsOfTheCheckpointAndGoesOn) {
  const ScratchDirectory scratch;
  const auto resumed = scratch / "resumed.csv", straight = scratch / "straight.csv";
  write_rows(straight, 10);
  write_rows(resumed, 8);
  put(scratch / "torn.csv", contents(resumed) + "7.5,12");  // killed in the middle of a row
  std::filesystem::rename(scratch / "torn.csv", resumed);
  {
    CsvWriter writer = CsvWriter::resume(resumed, abc, 5);
    EXPECT_EQ(writer.n_rows(), 5);
    for (int i = 5; i < 10; ++i) writer.append(std::vector<double>{i + 0., i / 3., -1. / (i + 1)});
    writer.flush();
    EXPECT_EQ(writer.n_rows(), 10);
  }
  EXPECT_EQ(contents(resumed), contents(straight));
}

TEST(Csv, ResumeRefusesTooFewRowsAndOtherColumns) {
  const ScratchDirectory scratch;
  const auto path = scratch / "t.csv";
  write_rows(path, 4);
  const std::string before = contents(path);
  const auto message = message_of<UserError>([&] { truncate_csv(path, abc, 5); });
  EXPECT_NE(message.find("has 4 rows, the checkpoint needs 5"), message.npos) << message;
  EXPECT_THROW(truncate_csv(path, Columns{"a", "b"}, 2), UserError);
  EXPECT_THROW(truncate_csv(path, Columns{"a", "b", "d"}, 2), UserError);
  EXPECT_THROW(CsvWriter::resume(scratch / "none.csv", abc, 0), UserError);
  EXPECT_EQ(contents(path), before);
  truncate_csv(path, abc, 0);
  EXPECT_EQ(contents(path), "a,b,c\n");
}

TEST(Csv, AFullDeviceIsAWriteErrorWithItsReason) {
  try {
    CsvWriter::create("/dev/full", abc);
    FAIL() << "no error";
  } catch (const WriteError& error) {
    EXPECT_EQ(error.error_number, ENOSPC);
    EXPECT_EQ(error.path, "/dev/full");
    EXPECT_STREQ(error.what(), "cannot write '/dev/full': No space left on device");
  }
  const ScratchDirectory scratch;
  EXPECT_THROW(CsvWriter::create(scratch / "no/such/folder.csv", abc), WriteError);
}

TEST(Csv, AWriteThatStopsHalfWayLeavesWholeRowsAndMayBeRepeated) {
  const ScratchDirectory scratch;
  const auto path = scratch / "t.csv";
  CsvWriter writer = CsvWriter::create(path, abc);
  writer.append(std::vector<double>{1, 2, 3});
  writer.flush();
  writer.append(std::vector<double>{4, 5, 6});
  {
    const FileSizeLimit full(14);  // room for two bytes of the second row
    EXPECT_THROW(writer.flush(), WriteError);
  }
  EXPECT_EQ(contents(path), "a,b,c\n1,2,3\n");
  writer.flush();
  EXPECT_EQ(contents(path), "a,b,c\n1,2,3\n4,5,6\n");
}

}  // namespace
}  // namespace pseudorigid::io::test
