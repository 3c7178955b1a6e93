// `encoder: {side: ...}` – which column is read, and what the model knows of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/configuration.h"
#include "config/texts.h"
#include "support/reading.h"

namespace gapscope {
namespace {

using ::testing::HasSubstr;
using testing::kRecorded;
using testing::kSimulated;
using testing::refusal;
using testing::with;

Configuration with_encoder(const std::string& encoder, const std::string& recording) {
  return parse_configuration("encoder: " + encoder + "\nrecording: " + recording + "\n", "c.yaml");
}

RecordingColumns columns_read(const Configuration& c) {
  return c.recording->reading_for(UnevenRows::kRefused).columns;
}

TEST(EncoderSide, IsThatOfTheMotorUnlessSaid) {
  const Configuration c = parse_configuration(kRecorded, "c.yaml");
  EXPECT_EQ(c.encoder.sides, EncoderSides::kMotor);
  EXPECT_EQ(c.model.structure.encoder, EncoderSide::kMotor);
  EXPECT_EQ(resolved_yaml(c).find("side:"), std::string::npos);
}

TEST(EncoderSide, OfTheLoadReadsX2) {
  const Configuration c = with_encoder("{bits: 16, side: load}", "{file: a.csv}");
  EXPECT_EQ(c.model.structure.encoder, EncoderSide::kLoad);
  EXPECT_EQ(c.recording->reading_for(UnevenRows::kStamped).encoder, EncoderSide::kLoad);
  EXPECT_EQ(columns_read(c).position, "x2");
  EXPECT_EQ(columns_read(c).load_position, "x1");
  EXPECT_FALSE(columns_read(c).load_position_required);
}

TEST(EncoderSide, OfTheLoadReadsTheColumnThatIsNamed) {
  const char* const load = "{bits: 16, side: load}";
  EXPECT_EQ(columns_read(with_encoder(load, "{file: a.csv, columns: {load_position: phi}}")).position, "phi");
  EXPECT_EQ(columns_read(with_encoder(load, "{file: a.csv, columns: {position: phi}}")).position, "phi");
  const RecordingColumns both =
      columns_read(with_encoder(load, "{file: a.csv, columns: {position: m, load_position: phi}}"));
  EXPECT_EQ(both.position, "phi");
  EXPECT_EQ(both.load_position, "m");
}

TEST(EncoderSide, OfTheLoadHasTheUnitAndTheGearOfItsColumn) {
  const Configuration c = with_encoder("{bits: 12, side: load}",
                                       "{file: a.csv, columns: {load_position: phi}, units: {load_position: "
                                       "counts}, gear_ratio: {load_position: 4}}");
  EXPECT_DOUBLE_EQ(c.position_quantum(), 2.0 * kPi / 4096.0 / 4.0);
  EXPECT_DOUBLE_EQ(columns_read(c).scales.position(8.0), 8.0 * c.position_quantum());
}

TEST(EncoderSide, OfBothNeedsTheSecondColumn) {
  const Configuration c = with_encoder("{bits: 16, side: both}", "{file: a.csv}");
  EXPECT_EQ(c.model.structure.encoder, EncoderSide::kMotor);
  EXPECT_EQ(columns_read(c).position, "x1");
  EXPECT_TRUE(columns_read(c).load_position_required);
}

TEST(Encoder, CountsPerTurnAreAsGoodAsBits) {
  const Configuration c = with_encoder("{counts: 2000}", "{file: a.csv}");
  EXPECT_DOUBLE_EQ(c.encoder.quantum, 2.0 * kPi / 2000.0);
  EXPECT_EQ(resolved_yaml(parse_configuration(resolved_yaml(c), "c.yaml")), resolved_yaml(c));
  EXPECT_THAT(refusal([] { with_encoder("{counts: 2000, bits: 11}", "{file: a.csv}"); }),
              HasSubstr("c.yaml:1: encoder.counts stands beside bits or quantum, expected one of the three"));
}

TEST(EncoderSide, NeedsNoStepBesideIt) {
  EXPECT_EQ(with_encoder("{side: load}", "{file: a.csv}").encoder.quantum, 0.0);
  EXPECT_THAT(refusal([] { with_encoder("{bits: 4, quantum: 1, side: load}", "{file: a.csv}"); }),
              HasSubstr("c.yaml:1: encoder has both of bits and quantum"));
  EXPECT_THAT(refusal([] { with_encoder("{side: output}", "{file: a.csv}"); }),
              HasSubstr("c.yaml:1: encoder.side is 'output', expected motor or load or both"));
}

TEST(EncoderSide, TellsNothingOfAnOutputThatDoesNotMove) {
  EXPECT_THAT(
      refusal([] {
        parse_configuration(
            "recording: {file: a.csv}\nencoder: {side: load}\nmodel: {load: locked, parameters: {}}\n",
            "c.yaml");
      }),
      HasSubstr("c.yaml:2: encoder.side is load and model.load locked, expected side: motor"));
}

TEST(EncoderSide, ComesBackFromTheResolvedText) {
  for (const char* side : {"load", "both"}) {
    const std::string own = with(kRecorded, "{bits: 20}", std::string("{bits: 20, side: ") + side + "}");
    const Configuration c = parse_configuration(own, "c.yaml");
    const std::string text = resolved_yaml(c);
    EXPECT_EQ(resolved_yaml(parse_configuration(text, "c.yaml")), text);
    EXPECT_EQ(columns_read(parse_configuration(text, "c.yaml")).position, columns_read(c).position);
  }
  const Configuration plain = with_encoder("{side: load}", "{file: a.csv}");
  const Configuration again = parse_configuration(resolved_yaml(plain), "c.yaml");
  EXPECT_EQ(again.encoder.sides, EncoderSides::kLoad);
  EXPECT_EQ(columns_read(again).position, "x2");
}

TEST(EncoderSide, IsThatOfTheSimulatedPlantToo) {
  const Configuration c = parse_configuration(kSimulated + "encoder: {bits: 18, side: load}\n", "c.yaml");
  EXPECT_EQ(c.simulation->plant.structure.encoder, EncoderSide::kLoad);
}

}  // namespace
}  // namespace gapscope
