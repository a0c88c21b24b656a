// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/cityjson/cityjson_text.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace standpoint {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kDeepest = 64;  // boundaries of a MultiSolid need nine levels, attributes hardly as many

// Walks through a text; values within the tree that is being built are put there, all others are told to the heirs.
class CityJsonWalk : public nlohmann::json_sax<Json> {
 public:
  CityJsonWalk(std::string_view text, const std::string& file, std::size_t first_line)
      : text_(text), file_(file), line_(first_line) {}

  Result<void> run() {
    const bool read = Json::sax_parse(text_.begin(), text_.end(), this);
    if (error_) return failure(*error_);
    return read ? Result<void>() : failure(ErrorKind::unusable, "is not JSON", file_);
  }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value), value); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value), value); }
  bool number_float(number_float_t value, const string_t&) override { return number(value, value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t&) override { return true; }
  bool start_object(std::size_t) override { return start(Json::object()); }
  bool start_array(std::size_t) override { return start(Json::array()); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(string_t& key) override {
    if (open_.empty()) {
      keys_.resize(depth_);
      keys_.back() = std::move(key);
    } else {
      key_ = std::move(key);
    }
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const Json::exception& error) override {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(position, text_.size()));
    const auto line = line_ + static_cast<std::size_t>(std::count(text_.begin(), end, '\n'));
    return refuse("is not JSON: " + std::string(error.what()), " line " + std::to_string(line));
  }

 protected:
  // Whether the value that begins is wanted as a tree; keys() says where it is.
  virtual bool wanted() = 0;
  virtual bool done(Json&& tree) = 0;
  virtual bool numberOutside(double) { return true; }
  virtual bool startOutside(bool) { return true; }
  virtual bool endOutside() { return true; }

  std::size_t depth() const { return depth_; }  // of containers outside the tree
  const std::vector<std::string>& keys() const { return keys_; }
  bool refuse(std::string message, const std::string& place) {
    error_ = Error{ErrorKind::unusable, std::move(message), file_ + place};
    return false;
  }
  bool refuse(Error error) {
    error_ = std::move(error);
    return false;
  }

 private:
  bool number(double value, Json exact) {
    return open_.empty() && !wanted() ? numberOutside(value) : put(std::move(exact));
  }

  Json* place(Json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Json& in = *open_.back();
    if (!in.is_array()) return &(in[key_] = std::move(value));
    in.push_back(std::move(value));
    return &in.back();
  }

  bool put(Json value) {
    if (open_.empty() && !wanted()) return true;
    place(std::move(value));
    return !open_.empty() || done(std::exchange(root_, nullptr));
  }

  bool start(Json&& container) {
    if (depth_ + open_.size() >= kDeepest)
      return refuse("is nested deeper than " + std::to_string(kDeepest) + " levels", "");
    if (!open_.empty() || wanted()) {
      open_.push_back(place(std::move(container)));
      return true;
    }
    ++depth_;
    keys_.resize(depth_);
    return startOutside(container.is_object());
  }

  bool end() {
    if (open_.empty()) {
      keys_.resize(--depth_);
      return endOutside();
    }
    open_.pop_back();
    return !open_.empty() || done(std::exchange(root_, nullptr));
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t line_;
  std::size_t depth_ = 0;
  std::vector<std::string> keys_;  // the last key in each container outside
  Json root_;
  std::vector<Json*> open_;
  std::string key_;
  std::optional<Error> error_;
};

// An array grows when a tree is put into it, but only the last element of one is ever open.
class FrameWalk : public CityJsonWalk {
 public:
  using CityJsonWalk::CityJsonWalk;
  CityJsonFrame frame;

 private:
  bool isIn(const char* member) const { return !keys().empty() && keys()[0] == member; }

  bool wanted() override { return depth() == 1 && !isIn("CityObjects") && !isIn("vertices"); }
  bool done(Json&& tree) override {
    frame.members[keys()[0]] = std::move(tree);
    return true;
  }
  bool startOutside(bool object) override {
    if (depth() == 1 && !object) return refuse("must be an object", "");
    if (isIn("CityObjects") && depth() == 2) {
      frame.has_objects = true;
      return object || refuse("must be an object", " /CityObjects");
    }
    if (!isIn("vertices") || depth() < 2) return true;
    if (object || depth() > 3) return refuse("must be a list of three numbers", place());
    numbers_ = 0;
    return true;
  }
  bool numberOutside(double value) override {
    if (!isIn("vertices")) return true;
    if (depth() != 3 || numbers_ == 3) return refuse("must be a list of three numbers", place());
    vertex_[numbers_++] = value;
    return true;
  }
  bool endOutside() override {
    if (!isIn("vertices") || depth() != 2) return true;
    if (numbers_ != 3) return refuse("must be a list of three numbers", place());
    frame.vertices.push_back(vertex_);
    return true;
  }
  std::string place() const { return " /vertices/" + std::to_string(frame.vertices.size()); }

  Eigen::Vector3d vertex_ = Eigen::Vector3d::Zero();
  int numbers_ = 0;
};

class ObjectsWalk : public CityJsonWalk {
 public:
  ObjectsWalk(std::string_view text, const std::string& file, std::size_t first_line,
              const std::function<Result<void>(std::string, const Json&)>& object)
      : CityJsonWalk(text, file, first_line), object_(object) {}

 private:
  bool wanted() override { return depth() == 2 && keys()[0] == "CityObjects"; }
  bool done(Json&& tree) override {
    auto ok = object_(keys()[1], tree);
    return ok || refuse(ok.error());
  }

  const std::function<Result<void>(std::string, const Json&)>& object_;
};

}  // namespace

Result<CityJsonFrame> readCityJsonFrame(std::string_view text, const std::string& file, std::size_t first_line) {
  FrameWalk walk(text, file, first_line);
  TRY(walk.run());
  return std::move(walk.frame);
}

Result<void> readCityObjects(std::string_view text, const std::string& file, std::size_t first_line,
                             const std::function<Result<void>(std::string, const Json&)>& object) {
  return ObjectsWalk(text, file, first_line, object).run();
}

const Json& cityMember(const Json& object, const char* key) {
  static const Json kNothing;
  if (!object.is_object()) return kNothing;
  const auto found = object.find(key);
  return found == object.end() ? kNothing : *found;
}

}  // namespace standpoint
