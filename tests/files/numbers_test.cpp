#include "gait/numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace gait {
namespace {

TEST(Numbers, are_read_whole_or_not_at_all) {
  EXPECT_EQ(number_in("1.5"), 1.5);
  EXPECT_EQ(number_in("-2e-3"), -0.002);
  EXPECT_EQ(number_in(".5"), 0.5);
  for (const char* text : {"", " 1", "1 ", "+1", "1,5", "0x10", "1e", "one", "--1", "inf", "nan"})
    EXPECT_FALSE(number_in(text)) << text;
}

TEST(Numbers, that_no_double_holds_are_infinite_or_zero_and_end_where_their_text_ends) {
  const LeadingNumber large = leading_number("-1e999 more"), small = leading_number("1e-999}");
  EXPECT_EQ(large.value, -INFINITY);
  EXPECT_EQ(large.length, 6u);
  EXPECT_EQ(small.value, 0);
  EXPECT_EQ(small.length, 6u);
  EXPECT_FALSE(number_in("1e999"));
  EXPECT_EQ(number_in("1e-999"), 0);
  EXPECT_EQ(leading_number("x").length, 0u);
}

TEST(Numbers, are_the_nearest_double_to_the_last_bit) {
  EXPECT_EQ(number_in("0.1"), 0.1);
  EXPECT_EQ(number_in("9007199254740993"), 9007199254740992.0);
  EXPECT_EQ(number_in("1.7976931348623157e308"), 1.7976931348623157e308);
  EXPECT_EQ(number_in("5e-324"), 5e-324);
}

TEST(Numbers, that_are_whole_must_fit_their_type) {
  EXPECT_EQ(whole_number_in<int>("-12"), -12);
  EXPECT_FALSE(whole_number_in<int>("12.0"));
  EXPECT_FALSE(whole_number_in<int>("99999999999"));
  EXPECT_FALSE(whole_number_in<std::uint64_t>("-3"));
  EXPECT_FALSE(whole_number_in<int>(""));
}

}  // namespace
}  // namespace gait
