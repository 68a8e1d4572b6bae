package gazed.spy;

import bot_core.image_t;
import gazed.fixation_t;
import gazed.head_command_t;
import gazed.head_state_t;
import gazed.located_point_t;
import gazed.saliency_map_t;
import gazed.status_t;
import java.util.ArrayList;
import java.util.List;

/** What has come of one robot. Messages are taken in LCM's thread and looked at in Swing's. */
final class Robot {
  /** As many fixations are listed. */
  static final int FIXATIONS_MAX = 20;

  /**
   * What there is to draw, at one moment; null what has not come yet. headAtImage, headAtMap: where the head was when these were taken.
   * Fixations: the newest first. `changes` counts messages.
   */
  record Sight(image_t image, String imageFault, saliency_map_t map, head_state_t headAtImage, head_state_t headAtMap, head_state_t head,
      head_command_t command, status_t status, List<Fixation> fixations, long changes, long heardNs) {
    /** As the newest fixation believes its camera and head to be. */
    BelievedRobot believed() {
      return fixations.isEmpty() || fixations.get(0).account() == null ? BelievedRobot.UNKNOWN : BelievedRobot.of(fixations.get(0).account());
    }
  }

  private static final Sight NOTHING = new Sight(null, null, null, null, null, null, null, null, List.of(), 0, 0);

  private final Frames frames = new Frames();
  private final HeadHistory heads = new HeadHistory();
  private Sight sight = NOTHING;

  synchronized Sight sight() {
    return sight;
  }

  synchronized void take(image_t image) {
    frames.add(image);
    replace(image, null, sight.map, sight.head, sight.command, sight.status, sight.fixations);
  }

  /** An image came that cannot be read. */
  synchronized void takeImageFault(String fault) {
    replace(sight.image, fault, sight.map, sight.head, sight.command, sight.status, sight.fixations);
  }

  synchronized void take(saliency_map_t map) {
    replace(sight.image, sight.imageFault, map, sight.head, sight.command, sight.status, sight.fixations);
  }

  synchronized void take(head_state_t head) {
    heads.add(head);
    replace(sight.image, sight.imageFault, sight.map, head, sight.command, sight.status, sight.fixations);
  }

  synchronized void take(head_command_t command) {
    replace(sight.image, sight.imageFault, sight.map, sight.head, command, sight.status, sight.fixations);
  }

  synchronized void take(status_t status) {
    replace(sight.image, sight.imageFault, sight.map, sight.head, sight.command, status, sight.fixations);
  }

  synchronized void take(located_point_t point) {
    takeFixation(Fixation.of(point));
  }

  synchronized void take(fixation_t account) {
    takeFixation(Fixation.of(account, frames));
  }

  /** Point and account come one after the other, in either order. What comes a second time is of a log that is played again. */
  private void takeFixation(Fixation fixation) {
    List<Fixation> fixations = new ArrayList<>(sight.fixations);
    int known = 0;
    while (known < fixations.size() && !fixations.get(known).isOf(fixation.utime(), fixation.number())) ++known;
    if (known < fixations.size() && fixation.completes(fixations.get(known))) {
      fixations.set(known, fixation.with(fixations.get(known)));
    } else {
      if (known < fixations.size()) fixation = fixation.with(fixations.remove(known));
      fixations.add(0, fixation);
      if (fixations.size() > FIXATIONS_MAX) fixations.remove(FIXATIONS_MAX);
    }
    replace(sight.image, sight.imageFault, sight.map, sight.head, sight.command, sight.status, List.copyOf(fixations));
  }

  private void replace(image_t image, String imageFault, saliency_map_t map, head_state_t head, head_command_t command, status_t status,
      List<Fixation> fixations) {
    head_state_t headAtImage = image == null ? null : heads.at(image.utime), headAtMap = map == null ? null : heads.at(map.utime);
    if (image == sight.image && headAtImage == null) headAtImage = sight.headAtImage;
    if (map == sight.map && headAtMap == null) headAtMap = sight.headAtMap;
    sight = new Sight(image, imageFault, map, headAtImage, headAtMap, head, command, status, fixations, sight.changes + 1, System.nanoTime());
  }
}
