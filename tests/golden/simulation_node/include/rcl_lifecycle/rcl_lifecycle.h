#error "The component 'lifecycle' is not selected: add `components: [+lifecycle]` to microros.yaml and generate again"
