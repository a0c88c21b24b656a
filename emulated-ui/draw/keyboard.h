// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace standpoint {

enum class KeyPage { letters, capitals, signs, figures };

// The keyboard that a device shows while one of its fields is edited. A real one goes on working beside it.
struct Keyboard {
  std::string field;  // the widget that is edited; empty: there is no keyboard
  KeyPage page = KeyPage::letters;
  bool fresh = false;                              // the field is to be moved out from below it
  std::string typed;                               // what the field has not taken yet; '\b' takes back
  float left = 0, top = 0, width = 0, height = 0;  // where it was drawn last, in pixels
};

// `key` is what it types, or "shift", "signs", "letters", "back", "ok".
struct KeyCap {
  std::string key;
  float x = 0, y = 0, width = 0, height = 0;  // in the keyboard, pixels
};
std::vector<KeyCap> keyCaps(KeyPage page, float width, float height, float gap);
int keyRows(KeyPage page);

// What a press of the key does to the keyboard; "ok" is left to the field, which takes over what is in it.
void pressKey(Keyboard& keyboard, const std::string& key);

}  // namespace standpoint
