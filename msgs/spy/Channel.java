package gazed.spy;

/** A channel's name in its parts: the prefix tells the robot ("GAZED_NAO7"), the ending what it is ("STATUS"). */
record Channel(String prefix, String ending) {
  private static final String[] ENDINGS =
      {"LOCATED_POINT", "FIXATION", "SALIENCY", "STATUS", "HEAD_STATE", "HEAD_COMMAND", "IMAGE"};

  /** A name with another ending, as a camera that is not gazed's own may have, is all prefix. */
  static Channel of(String name) {
    for (String ending : ENDINGS) {
      if (name.endsWith("_" + ending)) return new Channel(name.substring(0, name.length() - ending.length() - 1), ending);
    }
    return new Channel(name, "");
  }
}
