#include "coupling/study/runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>

#include "coupling/study/text_table.hpp"
#include "tests/unit/study/study_case.hpp"

namespace hemoscale::coupling {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A study whose program is a shell script: it notes each call, and ends as micro.cells says.
class RunnerTest : public testing::Test {
 protected:
  void SetUp() override {
    Summary summary;
    summary.title = "small";
    summary.figures = {{"f", 1.5, "m"}};
    write_summary(files.folder() / "template.json", summary);
    files.write(
        "program",
        "#!/bin/sh\n"
        "here=${0%/*}\n"
        "echo \"$@\" \"threads $OMP_NUM_THREADS\" >> $here/calls\n"
        "case \"$*\" in\n"
        "  *micro.cells=5*) echo 'hemoscale: the numerics failed'; echo '  step 3: too far';"
        " exit 4 ;;\n"
        "  *micro.cells=6*) exec sleep 100 ;;\n"
        "  *micro.cells=7*) echo 'hemoscale: a file failed'; echo '  no disk'; exit 3 ;;\n"
        "esac\n"
        "while [ \"$1\" != --results ]; do shift; done\n"
        "mkdir -p \"$2\" && cp $here/template.json \"$2/summary.json\"\n"
        "i=0; while [ $i -lt 20000 ]; do i=$((i + 1)); done\n");
    fs::permissions(files.folder() / "program", fs::perms::owner_all);
  }

  RunnerOptions options() const { return {files.folder() / "program", 1, false}; }

  PlannedRun planned(int cells) const {
    const StudyCase other(
        "[study]\nname = \"s\"\nset = { \"micro.cells\" = " + std::to_string(cells) + " }\n");
    PlannedRun run = plan_chart(other.read()).curves.at(0).points.at(0).run;
    run.case_folder = files.folder();
    run.label = "cells " + std::to_string(cells);
    return run;
  }

  std::size_t calls() const {
    std::ifstream file(files.folder() / "calls");
    std::size_t count = 0;
    for (std::string line; std::getline(file, line);) ++count;
    return count;
  }
  std::string last_call() const {
    std::ifstream file(files.folder() / "calls");
    std::string last;
    for (std::string line; std::getline(file, line);) last = line;
    return last;
  }

  StudyCase files{"[study]\nname = \"s\"\n"};
  Study study = files.read();
};

TEST_F(RunnerTest, a_run_is_a_process_with_the_settings_of_the_study) {
  study.threads = 3;
  PlannedRun run = planned(8);
  run.variant = "stiff";
  run.force = true;
  Runner runner(study, options());
  EXPECT_FALSE(runner.finished(run));
  const RunRecord record = runner.run(run);
  EXPECT_EQ(record.status, RunRecord::Status::finished);
  EXPECT_GT(record.cpu, 0);
  EXPECT_GE(record.wall, 0.9 * record.cpu);
  EXPECT_THAT(last_call(), HasSubstr("run " + files.folder().string()));
  for (const char* part : {"--variant stiff", "--force", "--set micro.cells=8", "threads 3"}) {
    EXPECT_THAT(last_call(), HasSubstr(part));
  }
  EXPECT_EQ(runner.summary_of(run).figures.at(0).value, 1.5);
  EXPECT_THAT(runner.folder_of(run).filename().string(), testing::StartsWith("cells-8-"));
}

TEST_F(RunnerTest, a_finished_run_is_not_made_again) {
  const RunRecord first = Runner(study, options()).run(planned(8));
  Runner later(study, options());
  EXPECT_TRUE(later.finished(planned(8)));
  PlannedRun renamed = planned(8);
  renamed.label = "another name of the same settings";
  EXPECT_EQ(later.run(renamed).cpu, first.cpu);
  EXPECT_EQ(calls(), 1U);
  later.run(planned(9));
  EXPECT_EQ(calls(), 2U);
}

TEST_F(RunnerTest, runs_of_another_build_are_kept_and_told) {
  const PlannedRun run = planned(8);
  fs::path file;
  {
    Runner runner(study, options());
    runner.run(run);
    EXPECT_EQ(runner.notes(true), "");
    file = runner.folder_of(run) / "record.json";
  }
  RunRecord record = *read_record(file);
  EXPECT_EQ(record.build.size(), 16U);
  record.build = "other";
  record.jobs = 2;
  write_record(file, record);
  Runner runner(study, options());
  runner.run(run);
  EXPECT_EQ(calls(), 1U);
  EXPECT_THAT(runner.notes(true), HasSubstr("1 runs were made by another build"));
  EXPECT_THAT(runner.notes(true), HasSubstr("1 runs were made beside others"));
  EXPECT_THAT(runner.notes(false), testing::Not(HasSubstr("beside others")));
}

TEST_F(RunnerTest, an_interrupted_run_is_made_anew) {
  fs::path folder;
  {
    Runner runner(study, options());
    runner.run(planned(8));
    folder = runner.folder_of(planned(8));
  }
  fs::remove(folder / "record.json");
  std::ofstream(folder / "half") << "written";
  Runner runner(study, options());
  runner.run(planned(8));
  EXPECT_EQ(calls(), 2U);
  EXPECT_FALSE(fs::exists(folder / "half"));
  fs::remove(folder / "results" / "summary.json");
  runner.run(planned(8));
  EXPECT_EQ(calls(), 3U);
}

TEST_F(RunnerTest, fresh_makes_each_run_again_once) {
  Runner(study, options()).run(planned(8));
  RunnerOptions fresh = options();
  fresh.fresh = true;
  Runner runner(study, fresh);
  runner.run(planned(8));
  runner.run(planned(8));
  EXPECT_EQ(calls(), 2U);
}

TEST_F(RunnerTest, repeats_give_the_smallest_time_and_more_of_them_a_new_run) {
  study.repeats = 3;
  const RunRecord record = Runner(study, options()).run(planned(8));
  EXPECT_EQ(record.repeats, 3);
  EXPECT_EQ(calls(), 3U);
  Runner runner(study, options());
  EXPECT_TRUE(runner.finished(planned(8)));
  EXPECT_FALSE(fs::exists(runner.folder_of(planned(8)) / "repeat"));
  study.repeats = 4;
  EXPECT_FALSE(runner.finished(planned(8)));
}

TEST_F(RunnerTest, failed_numerics_are_a_result_with_their_reason) {
  Runner runner(study, options());
  EXPECT_EQ(runner.run(planned(5)).status, RunRecord::Status::failed);
  const RunRecord again = runner.run(planned(5));
  EXPECT_EQ(again.message, "step 3: too far");
  EXPECT_EQ(calls(), 1U);
}

TEST_F(RunnerTest, a_run_that_takes_too_long_is_ended_and_tried_again_with_more_time) {
  study.longest = 0.3;
  Runner runner(study, options());
  const RunRecord record = runner.run(planned(6));
  EXPECT_EQ(record.status, RunRecord::Status::timed_out);
  EXPECT_THAT(record.message, HasSubstr("0.3 s"));
  EXPECT_LT(record.wall, 50);
  EXPECT_TRUE(runner.finished(planned(6)));
  study.longest = 0.4;
  EXPECT_FALSE(runner.finished(planned(6)));
}

TEST_F(RunnerTest, any_other_failure_ends_the_study_and_leaves_no_record) {
  Runner runner(study, options());
  try {
    runner.run(planned(7));
    FAIL();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"cells 7\" ended with exit code 3: no disk"));
  }
  EXPECT_FALSE(runner.finished(planned(7)));
}

TEST_F(RunnerTest, two_commands_on_one_study_do_not_mix) {
  const Runner first(study, options());
  EXPECT_THROW(Runner(study, options()), EnvironmentError);
}

TEST_F(RunnerTest, a_broken_record_is_named) {
  Runner runner(study, options());
  runner.run(planned(8));
  const fs::path file = runner.folder_of(planned(8)) / "record.json";
  for (const std::string text : {"", "{", "[]", "{\"format\": \"HemoScale run of a study\"}"}) {
    std::ofstream(file) << text;
    try {
      runner.finished(planned(8));
      ADD_FAILURE() << text;
    } catch (const EnvironmentError& error) {
      EXPECT_THAT(error.what(), HasSubstr(file.string()));
    }
  }
}

TEST(ForEachAtOnce, does_everything_once) {
  for (const int jobs : {1, 3, 20}) {
    std::vector<std::atomic<int>> done(10);
    for_each_at_once(done.size(), jobs, [&](std::size_t i) { ++done[i]; });
    for (const auto& each : done) EXPECT_EQ(each, 1);
  }
}

TEST(ForEachAtOnce, the_first_failure_ends_it) {
  std::atomic<int> done{0};
  EXPECT_THROW(for_each_at_once(100, 1,
                                [&](std::size_t i) {
                                  if (i == 3) throw EnvironmentError("x");
                                  ++done;
                                }),
               EnvironmentError);
  EXPECT_EQ(done, 3);
}

TEST(TextTable, csv_quotes_what_would_break_it) {
  const StudyCase files("");
  TextTable table;
  table.header = {"a", "b [s]", "c"};
  table.begin_row();
  table.add("x, \"y\"");
  table.add(0.1);
  table.begin_row();
  table.add("plain");
  table.add(std::nan(""));
  write_csv(files.folder() / "t.csv", table);
  std::ifstream file(files.folder() / "t.csv");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, "a,b [s],c\n\"x, \"\"y\"\"\",0.1,\nplain,,\n");
  EXPECT_EQ(aligned(table), "a       b [s]\nx, \"y\"  0.1\nplain\n");
}

}  // namespace
}  // namespace hemoscale::coupling
