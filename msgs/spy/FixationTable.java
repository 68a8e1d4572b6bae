package gazed.spy;

import java.awt.Component;
import java.awt.event.MouseEvent;
import java.util.List;
import javax.swing.JTable;
import javax.swing.ListSelectionModel;
import javax.swing.table.AbstractTableModel;
import javax.swing.table.DefaultTableCellRenderer;

/** The last fixations, newest first. One that is chosen is shown in the panels above until another is, or none. */
final class FixationTable extends JTable {
  private static final String[] TITLES = {"", "at", "outcome", "range", "looks", "why"};
  private static final int[] WIDTHS = {44, 68, 130, 130, 56, 0};
  private static final int OUTCOME = 2;

  private final Rows rows;

  FixationTable() {
    super(new Rows());
    rows = (Rows) getModel();
    setFont(Palette.PLAIN);
    setRowHeight(20);
    setShowGrid(false);
    setForeground(Palette.TEXT);
    setFillsViewportHeight(true);
    setSelectionMode(ListSelectionModel.SINGLE_SELECTION);
    getTableHeader().setFont(Palette.SMALL);
    getTableHeader().setReorderingAllowed(false);
    for (int i = 0; i < WIDTHS.length; ++i) {
      if (WIDTHS[i] == 0) continue;
      getColumnModel().getColumn(i).setPreferredWidth(WIDTHS[i]);
      getColumnModel().getColumn(i).setMaxWidth(WIDTHS[i] * 2);
    }
    setAutoResizeMode(AUTO_RESIZE_LAST_COLUMN);
    getColumnModel().getColumn(OUTCOME).setCellRenderer(new OutcomeRenderer());
  }

  void show(List<Fixation> fixations) {
    if (fixations == rows.fixations) return;
    Fixation kept = chosen();
    rows.fixations = fixations;
    rows.fireTableDataChanged();
    if (kept == null) return;
    // It may have got its other message meanwhile, or have left the list.
    for (int i = 0; i < fixations.size(); ++i) {
      if (fixations.get(i).isOf(kept.utime(), kept.number())) setRowSelectionInterval(i, i);
    }
  }

  /** What has no room in its cell. */
  @Override
  public String getToolTipText(MouseEvent event) {
    int row = rowAtPoint(event.getPoint());
    return row < 0 || row >= rows.fixations.size() ? null : Words.reason(rows.fixations.get(row));
  }

  /** Null when none is. */
  Fixation chosen() {
    int row = getSelectedRow();
    return row < 0 || row >= rows.fixations.size() ? null : rows.fixations.get(row);
  }

  private static final class Rows extends AbstractTableModel {
    private List<Fixation> fixations = List.of();

    @Override
    public int getRowCount() {
      return fixations.size();
    }

    @Override
    public int getColumnCount() {
      return TITLES.length;
    }

    @Override
    public String getColumnName(int column) {
      return TITLES[column];
    }

    @Override
    public Object getValueAt(int row, int column) {
      Fixation fixation = fixations.get(row);
      switch (column) {
        case 0: return fixation.number();
        case 1: return Words.time(fixation.utime());
        case OUTCOME: return fixation.outcome();
        case 3: return Words.range(fixation);
        case 4: return Words.looks(fixation);
        default: return Words.reason(fixation);
      }
    }
  }

  private static final class OutcomeRenderer extends DefaultTableCellRenderer {
    @Override
    public Component getTableCellRendererComponent(JTable table, Object value, boolean selected, boolean focus, int row, int column) {
      Outcome outcome = (Outcome) value;
      super.getTableCellRendererComponent(table, outcome.words, selected, false, row, column);
      setFont(Palette.BOLD);
      if (!selected) setForeground(outcome.colour);
      return this;
    }
  }
}
